#include <fmt/format.h>
#include <unistd.h>

#include <memory>

#include "emulator/app/command.hpp"
#include "emulator/app/measuring_options.hpp"
#include "emulator/core/progress.hpp"
#include "emulator/core/text_file.hpp"
#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/procedure/measure_colour.hpp"
#include "reports/colour_report.hpp"

namespace gonio::app {

namespace {

namespace fs = std::filesystem;

struct ColourCommandOptions {
  std::vector<std::string> samples;
  std::string instrument = "colorimeter_45_0";
  std::vector<std::string> geometries;
  std::string illuminant = ColourConditions{}.illuminant;
  std::string observer = ColourConditions{}.observer;
  double tolerance = ColourOptions{}.tolerance;
  std::string tilt = "0 deg";
  std::string wavelengths = "380:780:5";
  std::string format = "text";
  std::optional<std::string> spectrum;
  std::optional<std::string> report;
};

/// The page is made before anything is written.
void write_colour_report(const fs::path& folder, const ColourHeader& header,
                         const std::vector<ColourMeasurement>& measurements) {
  const std::string page = colour_page(header, measurements);
  fs::create_directories(folder);
  write_text_file(folder / "colour.html", page);
  write_text_file(folder / "colour.json", colour_json(header, measurements));
  write_text_file(folder / "colour.csv", colour_csv(header, measurements));
}

std::vector<ColourMeasurement> colours_of(const std::vector<Sample>& samples,
                                          const Colorimeter& colorimeter,
                                          const ColourConditions& conditions,
                                          const ColourOptions& options) {
  Progress progress(samples.size(), "samples");
  return measure_colours(samples, colorimeter, conditions, options, [&] { progress.advance(); });
}

void measure_colour_of(const ColourCommandOptions& options, const CommonOptions& common) {
  const Catalog catalog = common.catalog();
  const WavelengthGrid grid = parse_wavelengths(options.wavelengths);
  const ColourOptions colour_options{.geometries = options.geometries,
                                     .tolerance = options.tolerance,
                                     .tilt = parse_angle("--tilt", options.tilt, tilt_range())};
  const Instrument instrument =
      load_instrument(catalog.find(Catalog::Kind::instrument, options.instrument), catalog);
  const ColourConditions conditions =
      load_colour_conditions(catalog, options.illuminant, options.observer, grid);
  const Colorimeter colorimeter(instrument, grid, std::make_shared<ApertureIntegrator>(),
                                conditions.luminous_weight());
  std::vector<Sample> samples;
  for (const std::string& sample : options.samples) {
    samples.push_back(load_sample(catalog.find(Catalog::Kind::sample, sample), grid));
  }
  const std::vector<ColourMeasurement> measurements =
      colours_of(samples, colorimeter, conditions, colour_options);
  const ColourHeader header{.instrument = instrument, .conditions = conditions, .grid = grid};
  if (options.spectrum) {
    write_text_file(*options.spectrum, radiance_factor_csv(header, measurements));
  }
  if (options.report) {
    write_colour_report(*options.report, header, measurements);
  }
  print(options.format == "json"  ? colour_json(header, measurements)
        : options.format == "csv" ? colour_csv(header, measurements)
                                  : colour_text(header, measurements, isatty(STDOUT_FILENO) != 0));
}

}  // namespace

void add_colour_command(CLI::App& program, const CommonOptions& common) {
  CLI::App* command = program.add_subcommand(
      "colour", "Colour of samples by a colorimeter, a multi-angle instrument or a sphere");
  const auto options = std::make_shared<ColourCommandOptions>();
  command->add_option("--sample", options->samples, "Sample files or ids, see `gonio list samples`")
      ->required();
  command
      ->add_option("--instrument", options->instrument,
                   "File or id, e.g. colorimeter_45_0, multi_angle_45, sphere_8_d")
      ->capture_default_str();
  command->add_option("--geometry", options->geometries,
                      "Geometries, e.g. 45_as15; all if not given");
  command->add_option("--illuminant", options->illuminant, "For which the colour is computed")
      ->check(CLI::IsMember(colour_illuminants()))
      ->capture_default_str();
  command->add_option("--observer", options->observer, "Field of view in degrees")
      ->check(CLI::IsMember(colour_observers()))
      ->capture_default_str();
  command
      ->add_option("--tolerance", options->tolerance,
                   "Of the integrator, of the luminous radiance factor")
      ->check(number_in(Range::closed(1e-12, 1.0)))
      ->capture_default_str();
  command->add_option("--tilt", options->tilt, "Of the sample in the plane of measurement")
      ->capture_default_str();
  command->add_option("--wavelengths", options->wavelengths, "first:last:step in nm")
      ->capture_default_str();
  add_format_option(*command, options->format);
  command->add_option("--spectrum", options->spectrum, "CSV file for the radiance factors");
  command->add_option("--report", options->report,
                      "Folder for colour.html, .json and .csv; needs gnuplot");
  command->footer(
      "Example: gonio colour --sample red_satin --illuminant a --observer 2\n"
      "         gonio colour --sample silver_effect_paint --instrument multi_angle_45");
  command->callback([options, &common] { measure_colour_of(*options, common); });
}

}  // namespace gonio::app
