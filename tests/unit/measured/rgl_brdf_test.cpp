#include "emulator/measured/rgl_brdf.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "tests/unit/csv_rows.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/measured/brdf_at.hpp"

namespace gonio::test {
namespace {

const std::filesystem::path folder = std::filesystem::path(GONIO_SOURCE_DIR) / "fixtures/brdf";

/// The files of the reference tables that the source tree holds.
const MeasuredBrdf* shipped(const std::string& name) {
  static std::map<std::string, BrdfFile> files;
  if (!std::filesystem::exists(folder / name)) {
    return nullptr;
  }
  if (!files.contains(name)) {
    files.emplace(name, read_rgl(folder / name));
  }
  return files.at(name).brdf.get();
}

TEST(RglBrdf, EqualsTheReaderOfTheDatabase) {
  constexpr double tolerance = 1e-4;
  int rows = 0;
  for (const CsvRow& row : csv_rows(folder / "rgl_reference_slices.csv")) {
    const MeasuredBrdf* const brdf = shipped(row.text("file"));
    if (brdf == nullptr) {
      continue;
    }
    ++rows;
    // The table has the light at azimuth 0; gonio has it at pi.
    const double theta_r_deg = row.number("theta_o_deg");
    const Vector3 omega_r = direction(std::abs(theta_r_deg), theta_r_deg >= 0.0 ? 0.0 : 180.0);
    const Eigen::ArrayXd got = f_r_at(*brdf, direction(row.number("theta_i_deg"), 180.0), omega_r);
    for (const auto& [c, name] : {std::pair{0, "R"}, {1, "G"}, {2, "B"}}) {
      const double expected = row.number(name);
      EXPECT_TRUE(is_close(got(c) * omega_r.z(), expected, tolerance * expected))
          << row.text("file") << " " << row.text("theta_i_deg") << " " << theta_r_deg << name;
    }
  }
  EXPECT_GE(rows, 3 * 6 * 30);
}

TEST(RglBrdf, HasTheAlbedoOfTheDatabase) {
  // The table has four decimals, and was summed over the same 360 x 360 midpoints.
  constexpr double tolerance = 1e-3;
  constexpr double rounding = 0.5e-4;
  int rows = 0;
  for (const CsvRow& row : csv_rows(folder / "rgl_reference_albedo.csv")) {
    const MeasuredBrdf* const brdf = shipped(row.text("file"));
    if (brdf == nullptr) {
      continue;
    }
    ++rows;
    const Eigen::ArrayXd rho = rho_of(*brdf, direction(row.number("theta_i_deg"), 180.0), 360);
    for (const auto& [c, name] : {std::pair{0, "rho_R"}, {1, "rho_G"}, {2, "rho_B"}}) {
      const double expected = row.number(name);
      EXPECT_TRUE(is_close(rho(c), expected, tolerance * expected + rounding))
          << row.text("file") << " " << row.text("theta_i_deg") << " " << name;
    }
  }
  EXPECT_EQ(rows, 18);
}

}  // namespace
}  // namespace gonio::test
