#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "emulator/app/command.hpp"
#include "emulator/app/measuring_options.hpp"
#include "emulator/core/progress.hpp"
#include "emulator/core/text_file.hpp"
#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/procedure/profile.hpp"
#include "emulator/surface/sample.hpp"
#include "reports/profile_report.hpp"

namespace gonio::app {

namespace {

namespace fs = std::filesystem;

/// Gloss and its scale; its apertures at 20 deg stand in for those of other angles.
constexpr const char* gloss_standard = "iso_2813/2014";
constexpr const char* usual_geometry = "20";

std::string angle_text(Angle angle) { return fmt::format("{:.6g} deg", angle.degrees()); }

struct ProfileCommandOptions {
  std::vector<std::string> samples;
  std::string angle = angle_text(ProfileSetup{}.theta_i);
  std::string step = angle_text(ProfileSetup{}.step);
  std::string reach = angle_text(ProfileSetup{}.reach);
  std::string slit = angle_text(ProfileSetup{}.source_in_plane);
  std::string haze_field = angle_text(ProfileAssumptions{}.haze_field);
  std::string doi_field = angle_text(ProfileAssumptions{}.doi_field);
  std::string comb_distance = fmt::format("{:g} mm", ProfileAssumptions{}.comb_distance_mm);
  std::string tilt = "0 deg";
  std::string wavelengths = "380:780:5";
  std::string format = "text";
  std::optional<std::string> report;
};

const GeometryLimits* geometry_at(const Standard& standard, Angle theta_i) {
  constexpr double same_rad = 1e-9;
  for (const GeometryLimits& geometry : standard.geometries) {
    if (std::abs(geometry.theta_i.nominal.radians() - theta_i.radians()) < same_rad) {
      return &geometry;
    }
  }
  return nullptr;
}

ProfileSetup setup_of(const ProfileCommandOptions& options, const Standard& standard) {
  const Range opening{.low = 0.0, .high = 10.0, .low_open = true};
  ProfileSetup setup{
      .theta_i = parse_angle("--angle", options.angle, Range::closed(0.0, 89.0)),
      .step = parse_angle("--step", options.step, opening),
      .reach = parse_angle("--reach", options.reach, {.low = 0.0, .high = 60.0, .low_open = true}),
      .source_in_plane = parse_angle("--slit", options.slit, opening)};
  const GeometryLimits* found = geometry_at(standard, setup.theta_i);
  const GeometryLimits& across = found != nullptr ? *found : standard.geometry(usual_geometry);
  setup.source_perpendicular = across.source.perpendicular->known().nominal;
  setup.receptor_perpendicular = across.receptor.perpendicular->known().nominal;
  return setup;
}

ProfileAssumptions assumptions_of(const ProfileCommandOptions& options) {
  const Range opening{.low = 0.0, .high = 10.0, .low_open = true};
  return {.haze_field = parse_angle("--haze-field", options.haze_field, opening),
          .doi_field = parse_angle("--doi-field", options.doi_field, opening),
          .comb_distance_mm = parse_millimetres("--comb-distance", options.comb_distance,
                                                {.low = 1.0, .high = 1e4})};
}

std::vector<ProfileRule> all_rules(const Catalog& catalog) {
  std::vector<ProfileRule> rules;
  for (const Catalog::Entry& entry : catalog.list(Catalog::Kind::profile)) {
    for (const ProfileRule& rule : load_profile_rules(entry.file, catalog).rules) {
      rules.push_back(rule);
    }
  }
  return rules;
}

/// A row that reaches too far is the caller's mistake.
Profile profile_by(const ProfileCommandOptions& options, const Surface& surface,
                   const ProfileSetup& setup, const Eigen::ArrayXd& weight, Angle tilt = {}) {
  try {
    return measure_profile(surface, setup, weight, ApertureIntegrator(), tilt);
  } catch (const std::domain_error& error) {
    throw std::invalid_argument(fmt::format("--angle {}, --reach {}, --step {}: {}", options.angle,
                                            options.reach, options.step, error.what()));
  }
}

std::vector<ProfileMeasurement> profiles_of(const ProfileCommandOptions& options,
                                            const std::vector<Sample>& samples,
                                            const ProfileHeader& header,
                                            const Eigen::ArrayXd& weight) {
  const Angle tilt = parse_angle("--tilt", options.tilt, tilt_range());
  const GeometryLimits* gloss_geometry = geometry_at(header.standard, header.setup.theta_i);
  std::vector<ProfileMeasurement> measurements;
  Progress progress(samples.size(), "samples");
  for (const Sample& sample : samples) {
    ProfileMeasurement measurement{
        .sample = sample.id,
        .sample_title = sample.title,
        .profile = profile_by(options, sample.surface, header.setup, weight, sample.tilt + tilt),
        .quantities = {}};
    if (gloss_geometry != nullptr) {
      measurement.quantities.push_back(
          profile_gloss(measurement.profile, header.reference, header.standard, *gloss_geometry));
    }
    for (const ProfileQuantity& quantity :
         profile_quantities(measurement.profile, header.reference, header.setup.theta_i,
                            header.rules, header.assumptions)) {
      measurement.quantities.push_back(quantity);
    }
    measurements.push_back(std::move(measurement));
    progress.advance();
  }
  return measurements;
}

/// The page is made before anything is written.
void write_profile_report(const fs::path& folder, const ProfileHeader& header,
                          const std::vector<ProfileMeasurement>& measurements) {
  const std::string page = profile_page(header, measurements);
  fs::create_directories(folder);
  write_text_file(folder / "profile.html", page);
  write_text_file(folder / "profile.json", profile_json(header, measurements));
  write_text_file(folder / "profile.csv", profile_csv(header, measurements));
}

void take_profiles(const ProfileCommandOptions& options, const CommonOptions& common) {
  const Catalog catalog = common.catalog();
  const WavelengthGrid grid = parse_wavelengths(options.wavelengths);
  const Standard standard =
      load_standard(catalog.find(Catalog::Kind::standard, gloss_standard), catalog);
  const ProfileScale scale = profile_scale(standard, grid);
  const ProfileSetup setup = setup_of(options, standard);
  const ProfileAssumptions assumptions = assumptions_of(options);
  std::vector<Sample> samples;
  for (const std::string& sample : options.samples) {
    samples.push_back(load_sample(catalog.find(Catalog::Kind::sample, sample), grid));
  }
  const ProfileHeader header{
      .standard = standard,
      .setup = setup,
      .assumptions = assumptions,
      .rules = all_rules(catalog),
      .reference = profile_by(options, scale.reference, setup, scale.weight)};
  const std::vector<ProfileMeasurement> measurements =
      profiles_of(options, samples, header, scale.weight);
  if (options.report) {
    write_profile_report(*options.report, header, measurements);
  }
  print(options.format == "json"  ? profile_json(header, measurements)
        : options.format == "csv" ? profile_csv(header, measurements)
                                  : profile_text(header, measurements, isatty(STDOUT_FILENO) != 0));
}

}  // namespace

void add_profile_command(CLI::App& program, const CommonOptions& common) {
  CLI::App* command = program.add_subcommand(
      "profile", "Haze, distinctness of image and image clarity from the in-plane profile");
  const auto options = std::make_shared<ProfileCommandOptions>();
  const auto add = [&](const char* name, std::string& value, const char* what) {
    command->add_option(name, value, what)->capture_default_str();
  };
  command->add_option("samples", options->samples, "Sample files or ids, see `gonio list samples`")
      ->required();
  add("--angle", options->angle, "Of incidence");
  add("--step", options->step, "Width of a receptor element");
  add("--reach", options->reach, "Of the row of elements, to either side of the mirror direction");
  add("--slit", options->slit, "Width of the source in the plane; assumed");
  add("--haze-field", options->haze_field, "Width of haze fields that no standard states; assumed");
  add("--doi-field", options->doi_field, "Width of the receptor for distinctness; assumed");
  add("--comb-distance", options->comb_distance, "Focal length before the comb; assumed");
  add("--tilt", options->tilt, "Of the sample in the plane of measurement");
  add("--wavelengths", options->wavelengths, "first:last:step in nm");
  add_format_option(*command, options->format);
  command->add_option("--report", options->report,
                      "Folder for profile.html, .json and .csv; needs gnuplot");
  command->footer(
      "Example: gonio profile clearcoat_hazy clearcoat_orange_peel\n"
      "         gonio profile black_high_gloss --angle 30deg --reach 16deg");
  command->callback([options, &common] { take_profiles(*options, common); });
}

}  // namespace gonio::app
