#include <fmt/format.h>
#include <unistd.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "emulator/app/bars.hpp"
#include "emulator/app/command.hpp"
#include "emulator/core/parallel_for.hpp"
#include "emulator/core/text_file.hpp"
#include "emulator/goniometry/scan.hpp"
#include "emulator/goniometry/scan_samples.hpp"
#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/measured/astm_brdf.hpp"
#include "emulator/measured/rgl_writer.hpp"
#include "emulator/measured/sampled_brdf.hpp"
#include "reports/scan_report.hpp"

namespace gonio::app {

namespace {

namespace fs = std::filesystem;

struct ScanOptions {
  std::string sample;
  std::string plan = "in_plane";
  std::optional<std::string> theta_i, theta_r, phi_r, rotation;
  std::optional<std::string> source_aperture, receptor_aperture;
  std::optional<std::string> instrument, geometry;
  std::optional<std::string> wavelengths, source;
  std::optional<std::string> integrator;
  std::optional<int> patches;
  std::optional<double> tolerance;
  std::optional<std::string> heads_apart;
  bool reciprocal = false, full = false;
  std::string format = "text";
  std::optional<std::string> output;
  std::optional<std::string> as;
  std::optional<std::string> report;
};

void take_angles(const char* option, const std::optional<std::string>& text, const Range& range_deg,
                 std::vector<Angle>& angles) {
  if (!text) {
    return;
  }
  const auto found = parse_angles(*text);
  bool in_range = found.has_value();
  for (const Angle angle : found.value_or(std::vector<Angle>{})) {
    in_range = in_range && range_deg.contains(angle.degrees());
  }
  if (!in_range) {
    throw std::invalid_argument(
        fmt::format("{}: expected angles{} deg, e.g. '20 deg, 60 deg' or '0:80:5 deg', found '{}'",
                    option, range_deg.text(), *text));
  }
  angles = *found;
}

void take_opening(const char* option, const std::optional<std::string>& text,
                  ScanOpening& opening) {
  if (!text) {
    return;
  }
  const auto found = parse_opening(*text);
  if (!found) {
    throw std::invalid_argument(
        fmt::format("{}: expected full angles in (0, 120] deg, '4.7 deg' of a circle, '0.75 deg x "
                    "2.5 deg' of a rectangle, or 'collimated', found '{}'",
                    option, *text));
  }
  opening = *found;
}

void take_scan_integrator(const ScanOptions& options, ScanPlan& plan) {
  if (options.integrator) {
    plan.integrator =
        *options.integrator == "patches" ? ScanIntegrator::patches : ScanIntegrator::aperture;
  }
  if (options.patches) {
    if (plan.integrator != ScanIntegrator::patches) {
      throw std::invalid_argument("--patches: expected --integrator patches with it");
    }
    if (*options.patches < 4 || *options.patches % 4 != 0 || *options.patches > 4096) {
      throw std::invalid_argument(fmt::format(
          "--patches: expected a multiple of 4 in [4, 4096], found '{}'", *options.patches));
    }
    plan.patches = *options.patches;
  }
  plan.tolerance = options.tolerance.value_or(plan.tolerance);
}

void take_apertures_of(const ScanOptions& options, const Catalog& catalog, ScanPlan& plan) {
  if (options.instrument.has_value() != options.geometry.has_value()) {
    throw std::invalid_argument("--instrument and --geometry: expected both or none");
  }
  if (options.instrument) {
    take_apertures(plan, catalog.find(Catalog::Kind::instrument, *options.instrument),
                   *options.geometry, catalog);
  }
  if (options.source_aperture || options.receptor_aperture) {
    plan.instrument.reset();
  }
  take_opening("--source-aperture", options.source_aperture, plan.source);
  take_opening("--receptor-aperture", options.receptor_aperture, plan.receptor);
}

/// A file, or the id of a plan that is shipped.
fs::path plan_file(const std::string& id_or_path, const Catalog& catalog) {
  if (what_stands_at(id_or_path) == "a file") {
    return id_or_path;
  }
  try {
    return catalog.fixture(fs::path("scans") / fmt::format("{}.yaml", id_or_path));
  } catch (const InputError&) {
    throw InputError({.file = id_or_path},
                     "a scan file, or an id of those in fixtures/scans, e.g. in_plane, hemisphere",
                     what_stands_at(id_or_path));
  }
}

ScanPlan plan_by(const ScanOptions& options, const Catalog& catalog) {
  ScanPlan plan = load_scan_plan(plan_file(options.plan, catalog), catalog);
  take_angles("--theta-i", options.theta_i, ScanPlan::range_theta_i(), plan.theta_i);
  take_angles("--theta-r", options.theta_r, ScanPlan::range_theta_r(), plan.theta_r);
  take_angles("--phi-r", options.phi_r, ScanPlan::range_azimuth(), plan.phi_r);
  take_angles("--rotation", options.rotation, ScanPlan::range_azimuth(), plan.rotation);
  take_apertures_of(options, catalog, plan);
  take_scan_integrator(options, plan);
  if (options.wavelengths) {
    const auto grid = parse_wavelength_grid(
        options.wavelengths->ends_with("nm") ? *options.wavelengths : *options.wavelengths + " nm");
    if (!grid) {
      throw std::invalid_argument(fmt::format(
          "--wavelengths: expected first:last:step in nm, a whole number of steps, found '{}'",
          *options.wavelengths));
    }
    plan.grid = *grid;
  }
  if (options.source) {
    plan.spectrum = *options.source;
  }
  if (options.heads_apart) {
    std::vector<Angle> apart;
    take_angles("--heads-apart", options.heads_apart, Range::closed(0.0, 90.0), apart);
    plan.heads_apart = apart.front();
  }
  if (options.reciprocal || options.full) {
    plan.reciprocity = options.full ? UseOfReciprocity::no : UseOfReciprocity::yes;
  }
  return plan;
}

/// What the scan's sums are to be near to; nothing of a scan that makes no sums.
std::vector<double> integrated_reflectance(const Sample& sample, const ScanResult& result,
                                           const std::vector<ScanLobe>& lobes) {
  constexpr double tolerance = 1e-5;
  constexpr std::size_t most_lobes = 100;
  if (lobes.empty() || lobes.size() > most_lobes || !lobes.front().hemispherical) {
    return {};
  }
  std::vector<double> reflectance(lobes.size());
  parallel_for(lobes.size(), [&](std::size_t k) {
    const ScanPosition& position = result.positions[std::size_t(lobes[k].positions.front())];
    const Vector3 omega_i = frame_towards(position.theta_i, position.azimuth_i()).axis;
    const Eigen::ArrayXd& weight = result.light.weight;
    const Flux flux =
        ApertureIntegrator().hemispherical(sample.surface, omega_i, weight, tolerance);
    reflectance[k] = (weight * flux.spectral).sum();
  });
  return reflectance;
}

void write_scan_file(const fs::path& path, const std::string& as, const ScanReport& report) {
  write_file(path, [&](std::ostream& out) {
    const TextSink write = [&](std::string_view text) {
      out.write(text.data(), std::streamsize(text.size()));
    };
    if (as == "json") {
      write_scan_json(report, write);
    } else if (as == "astm") {
      write_astm(brdf_samples(report.result, report.plan, report.sample), out);
    } else {
      write_scan_csv(report, write);
    }
  });
}

/// As a table of the RGL, which is between the directions of the scan, at its angles of incidence.
void write_rgl_table(const fs::path& path, const ScanReport& report) {
  const BrdfSamples samples = brdf_samples(report.result, report.plan, report.sample);
  std::vector<std::string> warnings;
  const SampledBrdf table(samples, warnings);
  std::string description;
  for (const auto& [key, value] : samples.notes) {
    description += fmt::format("{}: {}\n", key, value);
  }
  write_rgl(path, table, {.description = description});
  for (const std::string& warning : warnings) {
    fmt::print(stderr, "gonio: {}: {}\n", path.string(), warning);
  }
}

void write_scan_report(const fs::path& folder, const ScanReport& report) {
  const std::string page = scan_page(report);
  fs::create_directories(folder);
  write_text_file(folder / "scan.html", page);
  write_scan_file(folder / "scan.json", "json", report);
  write_scan_file(folder / "scan.csv", "csv", report);
}

void print_scan(const ScanReport& report, const std::string& format) {
  if (format == "json") {
    write_scan_json(report, print);
  } else if (format == "csv") {
    write_scan_csv(report, print);
  } else {
    print(scan_text(report, isatty(STDOUT_FILENO) != 0));
  }
}

void scan_by(const ScanOptions& options, const CommonOptions& common) {
  if (options.as && !options.output) {
    throw std::invalid_argument("--as: expected --output with it");
  }
  const Catalog catalog = common.catalog();
  const ScanPlan plan = plan_by(options, catalog);
  if (options.as == "rgl" && plan.rotation.size() > 1) {
    throw std::invalid_argument(
        "--as rgl: expected one rotation of the sample, since the table is one of an isotropic "
        "one");
  }
  const ScanLight light = scan_light(plan, catalog);
  const Sample sample = load_sample(catalog.find(Catalog::Kind::sample, options.sample), plan.grid);
  ScanResult result;
  {
    Bars bars;
    result = scan(sample, plan, light, [&](std::size_t done, std::size_t total) {
      bars.show("positions", done, total);
    });
  }
  ScanReport report{.sample = sample.id,
                    .sample_title = sample.title,
                    .plan = plan,
                    .result = result,
                    .lobes = scan_lobes(result)};
  if (sample.tilt == Angle{}) {
    report.integrated = integrated_reflectance(sample, result, report.lobes);
  }
  if (options.output) {
    if (options.as == "rgl") {
      write_rgl_table(*options.output, report);
    } else {
      write_scan_file(*options.output, options.as.value_or("csv"), report);
    }
  }
  if (options.report) {
    write_scan_report(*options.report, report);
  }
  print_scan(report, options.format);
  if (result.missed > 0 && plan.integrator == ScanIntegrator::aperture) {
    fmt::print(stderr, "gonio: the integrator missed the tolerance at {} positions\n",
               result.missed);
  }
}

void add_scan_options(CLI::App& command, ScanOptions& options) {
  command.add_option("--theta-i", options.theta_i, "Of the source: '20 deg, 60 deg', '0:80:5 deg'");
  command.add_option("--theta-r", options.theta_r,
                     "Of the receptor; below 0 past the normal, in the plane of measurement");
  command.add_option("--phi-r", options.phi_r, "Azimuths of the receptor; 0 deg: mirror side");
  command.add_option("--rotation", options.rotation, "Of the sample about its normal");
  command.add_option("--source-aperture", options.source_aperture,
                     "'4.7 deg' (circle), '0.75 deg x 2.5 deg' or 'collimated'");
  command.add_option("--receptor-aperture", options.receptor_aperture, "In the same form");
  command.add_option("--instrument", options.instrument, "Takes the apertures of an instrument");
  command.add_option("--geometry", options.geometry, "Of that instrument, e.g. 60");
  command.add_option("--wavelengths", options.wavelengths, "first:last:step in nm");
  command.add_option("--source", options.source, "CSV file of the source's spectrum; D65 if none");
  command.add_option("--integrator", options.integrator, "How fluxes are integrated")
      ->check(CLI::IsMember({"aperture", "patches"}));
  command.add_option("--patches", options.patches, "N of the 3 N^2 patches of the hemisphere");
  command.add_option("--tolerance", options.tolerance, "On f_r, of f_r + 0.001 / sr")
      ->check(number_in(ScanPlan::range_tolerance()));
  command.add_option("--heads-apart", options.heads_apart,
                     "Least angle between the axes of source and receptor");
  auto* reciprocal = command.add_flag("--reciprocal", options.reciprocal,
                                      "Leave out what reciprocity tells, or fail");
  command.add_flag("--full", options.full, "Measure every position")->excludes(reciprocal);
}

}  // namespace

void add_scan_command(CLI::App& program, const CommonOptions& common) {
  CLI::App* command = program.add_subcommand(
      "scan", "BRDF and spectral flux of a sample, source and receptor moved over the hemisphere");
  const auto options = std::make_shared<ScanOptions>();
  command->add_option("--sample", options->sample, "Sample file or id, see `gonio list samples`")
      ->required();
  command
      ->add_option("--plan", options->plan,
                   "Scan file, or in_plane, hemisphere, turned, paper_in_plane; options below "
                   "replace what it says")
      ->capture_default_str();
  add_scan_options(*command, *options);
  add_format_option(*command, options->format);
  command->add_option("--output", options->output, "File for all positions");
  command->add_option("--as", options->as, "Format of that file; csv if not given")
      ->check(CLI::IsMember({"csv", "json", "astm", "rgl"}));
  command->add_option("--report", options->report,
                      "Folder for scan.html, .json and .csv; needs gnuplot");
  command->footer(
      "Example: gonio scan --sample copper_polished\n"
      "         gonio scan --sample steel_brushed --plan turned --format csv");
  command->callback([options, &common] { scan_by(*options, common); });
}

}  // namespace gonio::app
