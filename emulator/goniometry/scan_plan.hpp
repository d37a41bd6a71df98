#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/core/catalog.hpp"
#include "emulator/core/quantity.hpp"
#include "emulator/core/table.hpp"
#include "emulator/core/wavelength_grid.hpp"
#include "emulator/goniometry/goniometer.hpp"

namespace gonio {

enum class ScanIntegrator { aperture, patches };

/// Whether positions are left out that another one tells by reciprocity.
enum class UseOfReciprocity {
  automatic,  ///< where both apertures are equal and the sample keeps to it
  yes,
  no
};

/// What a goniometer is to do.
struct ScanPlan {
  /// What one scan may hold: its numbers stay in memory until they are written.
  static constexpr double most_positions = 1e6;
  static constexpr double most_numbers = 25e6;  ///< positions times wavelengths, 200 MB

  // What its angles [deg] and its tolerance may be.
  static Range range_theta_i() { return {.low = 0.0, .high = 90.0, .high_open = true}; }
  static Range range_theta_r() {
    return {.low = -90.0, .high = 90.0, .low_open = true, .high_open = true};
  }
  static Range range_azimuth() { return Range::closed(-360.0, 360.0); }
  static Range range_tolerance() { return Range::closed(1e-9, 0.1); }

  std::string id = "in_plane";
  std::string title = "Scan in the plane of measurement";
  std::string notes = {};
  std::vector<Angle> theta_i = {degrees(20), degrees(45), degrees(60)};  ///< in [0, 90) deg
  std::vector<Angle> theta_r = {};  ///< in (-90, 90) deg; empty: -85 to 85 deg by 1 deg
  std::vector<Angle> phi_r = {Angle{}};
  std::vector<Angle> rotation = {Angle{}};
  ScanOpening source = {.in_plane = degrees(1), .perpendicular = degrees(1)};
  ScanOpening receptor = {.in_plane = degrees(1), .perpendicular = degrees(1)};
  std::optional<std::string> instrument = {};  ///< whose apertures they are, in words
  WavelengthGrid grid = WavelengthGrid::visible();
  std::filesystem::path spectrum = {};  ///< of the source; empty: D65
  ScanIntegrator integrator = ScanIntegrator::aperture;
  int patches = 256;                ///< N of the 3 N^2 patches
  double tolerance = 1e-4;          ///< on f_r, relative to f_r + 0.001 / sr
  Angle heads_apart = degrees(10);  ///< positions whose axes are nearer are out of reach
  UseOfReciprocity reciprocity = UseOfReciprocity::automatic;

  /// Every position asked for, within reach or not; by rotation, theta_i, azimuth and theta_r. The
  /// normal is one position: only the first azimuth goes there.
  /// @throws std::invalid_argument  if there are more than a scan may hold.
  [[nodiscard]] std::vector<ScanPosition> positions() const;
};

/// Angles as text: "20 deg, 60 deg" or "0:80:5 deg", which is first, last and step.
/// @return  nothing if it is neither, or the step does not lead to the last angle.
[[nodiscard]] std::optional<std::vector<Angle>> parse_angles(std::string_view text);
/// "4.7 deg" is a circle, "0.75 deg x 2.5 deg" a rectangle (in the plane of measurement x
/// perpendicular to it), "collimated" has no extent.
/// @return  nothing if it is none of them, or an angle is outside (0, 120] deg.
[[nodiscard]] std::optional<ScanOpening> parse_opening(std::string_view text);
/// "380:780:5 nm": first, last and step; nothing if it is not that.
[[nodiscard]] std::optional<WavelengthGrid> parse_wavelength_grid(std::string_view text);

/// Takes the apertures of an instrument's geometry. @throws as Instrument::geometry.
void take_apertures(ScanPlan& plan, const std::filesystem::path& instrument,
                    const std::string& geometry, const Catalog& catalog);

/// Reads a file of schema gonio/scan/1.
/// @throws InputError  for anything that is not as the schema says.
[[nodiscard]] ScanPlan load_scan_plan(const std::filesystem::path& path, const Catalog& catalog);

}  // namespace gonio
