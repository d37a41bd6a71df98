#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "emulator/app/command.hpp"
#include "emulator/app/measuring_options.hpp"
#include "emulator/core/progress.hpp"
#include "emulator/core/quantity.hpp"
#include "emulator/core/text_file.hpp"
#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/integration/patch_integrator.hpp"
#include "emulator/optics/refractive_index.hpp"
#include "emulator/procedure/footprint.hpp"
#include "emulator/procedure/measure.hpp"
#include "reports/measurement_report.hpp"

namespace gonio::app {

namespace {

constexpr int default_patches = 256;

struct MeasureArguments {
  std::vector<std::string> samples;
  std::string standard = "iso_2813/2014";
  std::optional<std::string> instrument;
  std::vector<std::string> geometries;
  std::string integrator = "aperture";
  std::optional<int> patches;
  double tolerance = MeasureOptions{}.tolerance;
  std::string tilt = "0 deg";
  std::optional<std::string> position;
  std::optional<std::string> reference_glass;
  std::string wavelengths = "380:780:5";
  std::string format = "text";
  std::optional<std::string> spectrum;
  std::optional<std::string> report;
};

/// `X, Y`, two lengths.
std::optional<PanelPosition> parse_position(const std::optional<std::string>& text) {
  if (!text) {
    return std::nullopt;
  }
  constexpr double per_nanometre = 1e-6;
  std::vector<double> place_mm;
  for (const std::string& part : CLI::detail::split(*text, ',')) {
    const auto length = parse_quantity(CLI::detail::trim_copy(part), Dimension::length);
    if (!length) {
      break;
    }
    place_mm.push_back(*length * per_nanometre);
  }
  if (place_mm.size() != 2 || std::count(text->begin(), text->end(), ',') != 1) {
    throw std::invalid_argument(fmt::format(
        "--position: expected two lengths (nm, um, mm), e.g. '75 mm, 50 mm', found '{}'", *text));
  }
  return PanelPosition{.x_mm = place_mm[0], .y_mm = place_mm[1]};
}

std::shared_ptr<const FluxIntegrator> make_integrator(const MeasureArguments& options) {
  if (options.integrator == "aperture") {
    if (options.patches) {
      throw std::invalid_argument("--patches: expected --integrator patches with it");
    }
    return std::make_shared<ApertureIntegrator>();
  }
  const int patches = options.patches.value_or(default_patches);
  if (patches < 4 || patches % 4 != 0 || patches > 4096) {
    throw std::invalid_argument(
        fmt::format("--patches: expected a multiple of 4 in [4, 4096], found '{}'", patches));
  }
  return std::make_shared<PatchIntegrator>(patches);
}

Instrument make_instrument(const MeasureArguments& options, const Catalog& catalog) {
  if (options.instrument) {
    return load_instrument(catalog.find(Catalog::Kind::instrument, *options.instrument), catalog);
  }
  return nominal_instrument(
      load_standard(catalog.find(Catalog::Kind::standard, options.standard), catalog));
}

/// The index of a reference glass that was asked for; empty for the standard's own reference.
Eigen::ArrayXcd reference_index(const MeasureArguments& options, const Standard& standard,
                                const WavelengthGrid& grid) {
  if (!options.reference_glass) {
    return {};
  }
  if (standard.scale.reference == Scale::Reference::incident_flux) {
    throw std::invalid_argument(fmt::format(
        "--reference-glass: expected a standard with a reference glass, found '{}', whose scale is "
        "relative to the incident flux",
        standard.id));
  }
  return RefractiveIndex::load(*options.reference_glass).sample(grid);
}

std::string describe_reference(const MeasureArguments& options, const Scale& scale) {
  if (scale.reference == Scale::Reference::incident_flux) {
    return fmt::format("scale {:g} x reflected / incident flux", scale.value.nominal);
  }
  if (options.reference_glass) {
    return fmt::format("reference glass of {}, dispersive", *options.reference_glass);
  }
  return fmt::format("reference glass n = {:g} at all wavelengths",
                     scale.refractive_index->nominal);
}

void warn_of_missed_tolerance(const std::vector<Measurement>& measurements, double tolerance) {
  for (const Measurement& measurement : measurements) {
    for (const GeometryResult& result : measurement.geometries) {
      if (result.reading.quadrature_error > tolerance) {
        fmt::print(
            stderr,
            "gonio: {} at {}: the integrator's error is {:.1e}, more than the {:.1e} asked for\n",
            measurement.sample, result.id, result.reading.quadrature_error, tolerance);
      }
    }
  }
}

void warn_of_measured_data(const std::vector<Measurement>& measurements) {
  for (const Measurement& measurement : measurements) {
    for (const std::string& warning : measurement.warnings) {
      fmt::print(stderr, "gonio: {}: {}\n", measurement.sample, warning);
    }
  }
}

/// What the receptors see of each sample that has a lobe. Nothing of a tilted one, whose lobe lies
/// elsewhere.
std::vector<std::vector<Footprint>> footprints_of(const Instrument& instrument,
                                                  const std::vector<Sample>& samples,
                                                  const std::vector<Measurement>& measurements,
                                                  Angle tilt) {
  std::vector<std::vector<Footprint>> footprints(samples.size());
  Progress progress(samples.size(), "footprints");
  for (std::size_t i = 0; i < samples.size(); ++i, progress.advance()) {
    if (!samples[i].surface.scatters() || tilt.radians() != 0.0) {
      continue;
    }
    for (const GeometryResult& result : measurements[i].geometries) {
      footprints[i].push_back(footprint(instrument, result.id, samples[i]));
    }
  }
  return footprints;
}

/// The report as a page, as JSON and as CSV, in a folder that is made if it is not there.
void write_report(const std::filesystem::path& folder, const MeasurementHeader& header,
                  const std::vector<Measurement>& measurements,
                  const std::vector<std::vector<Footprint>>& footprints) {
  const std::string page = measurement_page(header, measurements, footprints);
  std::filesystem::create_directories(folder);
  write_text_file(folder / "measurement.html", page);
  write_text_file(folder / "measurement.json", measurement_json(header, measurements));
  write_text_file(folder / "measurement.csv", measurement_csv(header, measurements));
}

void run_measure(const MeasureArguments& options, const CommonOptions& common) {
  const Catalog catalog = common.catalog();
  const WavelengthGrid grid = parse_wavelengths(options.wavelengths);
  const MeasureOptions measure_options{.geometries = options.geometries,
                                       .tolerance = options.tolerance,
                                       .tilt = parse_angle("--tilt", options.tilt, tilt_range()),
                                       .position = parse_position(options.position)};
  const Instrument instrument = make_instrument(options, catalog);
  const Glossmeter glossmeter(instrument, grid, make_integrator(options),
                              reference_index(options, instrument.standard, grid));
  const Observer observer = Observer::load(catalog.fixture("observers/cie_1931_2deg.csv"), grid);
  std::vector<Sample> samples;
  for (const std::string& sample : options.samples) {
    samples.push_back(load_sample(catalog.find(Catalog::Kind::sample, sample), grid));
  }

  std::vector<Measurement> measurements;
  {
    Progress progress(samples.size(), "samples");
    measurements =
        measure_all(samples, glossmeter, observer, measure_options, [&] { progress.advance(); });
  }
  const MeasurementHeader header{
      .standard = instrument.standard,
      .instrument = instrument.title,
      .integrator = options.integrator,
      .reference = describe_reference(options, instrument.standard.scale),
      .grid = grid};
  if (options.spectrum) {
    write_text_file(*options.spectrum, spectra_csv(header, measurements));
  }
  if (options.report) {
    write_report(*options.report, header, measurements,
                 footprints_of(instrument, samples, measurements, measure_options.tilt));
  }
  print(options.format == "json" ? measurement_json(header, measurements)
        : options.format == "csv"
            ? measurement_csv(header, measurements)
            : measurement_text(header, measurements, isatty(STDOUT_FILENO) != 0));
  warn_of_measured_data(measurements);
  if (options.integrator == "aperture") {
    warn_of_missed_tolerance(measurements, options.tolerance);
  }
}

}  // namespace

void add_measure_command(CLI::App& program, const CommonOptions& common) {
  CLI::App* command = program.add_subcommand(
      "measure", "Gloss and spectral reflectance of samples by a standard or an instrument");
  const auto options = std::make_shared<MeasureArguments>();
  command->add_option("--sample", options->samples, "Sample files or ids, see `gonio list samples`")
      ->required();
  auto* standard = command
                       ->add_option("--standard", options->standard,
                                    "Standard whose nominal geometries are measured")
                       ->capture_default_str();
  command->add_option("--instrument", options->instrument, "Instrument as built: a file or an id")
      ->excludes(standard);
  command->add_option("--geometry", options->geometries, "Geometries, e.g. 60; all if not given");
  command->add_option("--integrator", options->integrator, "How fluxes are integrated")
      ->check(CLI::IsMember({"aperture", "patches"}))
      ->capture_default_str();
  command->add_option("--patches", options->patches, "N of the 3 N^2 patches of the hemisphere")
      ->default_str(std::to_string(default_patches));
  command->add_option("--tolerance", options->tolerance, "Of the aperture integrator, in GU")
      ->check(number_in(Range::closed(1e-12, 1e3)))
      ->capture_default_str();
  command->add_option("--tilt", options->tilt, "Of the sample in the plane of measurement")
      ->capture_default_str();
  command->add_option("--position", options->position,
                      "Of the measuring spot on a panel, 'X mm, Y mm'; its centre if not given");
  command->add_option("--reference-glass", options->reference_glass,
                      "Refractive index file of a dispersive reference, which then reads 100");
  command->add_option("--wavelengths", options->wavelengths, "first:last:step in nm")
      ->capture_default_str();
  add_format_option(*command, options->format);
  command->add_option("--spectrum", options->spectrum, "CSV file for the spectral reflectances");
  command->add_option("--report", options->report,
                      "Folder for measurement.html, .json and .csv; needs gnuplot");
  command->footer(
      "Example: gonio measure --sample copper_polished --sample black_glass_n1567 --geometry 60\n"
      "         gonio measure --sample my_paint.yaml --instrument triangle_gloss --format json");
  command->callback([options, &common] { run_measure(*options, common); });
}

}  // namespace gonio::app
