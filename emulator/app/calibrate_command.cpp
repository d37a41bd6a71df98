#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "emulator/app/command.hpp"
#include "emulator/core/progress.hpp"
#include "emulator/core/text_file.hpp"
#include "emulator/goniometry/acquisition.hpp"
#include "emulator/goniometry/calibration_plan.hpp"
#include "emulator/goniometry/instrument_file.hpp"
#include "emulator/goniometry/setup_calibration.hpp"
#include "emulator/integration/aperture_integrator.hpp"
#include "reports/calibration_report.hpp"

namespace gonio::app {

namespace {

namespace fs = std::filesystem;

struct CalibrateOptions {
  std::optional<std::string> spectra;
  std::optional<std::string> plan;
  std::optional<std::string> instrument;
  std::vector<std::string> samples;
  std::vector<std::string> geometries;
  std::vector<std::string> free;
  std::optional<std::string> relative_to;
  std::string method = "both";
  std::string format = "text";
  std::optional<std::string> report;
  std::optional<std::string> write_instrument;
};

/// The spectra of one sample.
struct MeasuredSample {
  fs::path sample;
  std::string spectra_file;
  std::vector<ReflectanceSpectrum> spectra = {};
};

/// From a table of spectra, or from what a spectrometer counted.
std::vector<ReflectanceSpectrum> load_spectra(const std::string& name, const Catalog& catalog) {
  const fs::path file = find_acquisition(name, catalog);
  constexpr std::size_t head = 4096;
  if (read_text_file(file).substr(0, head).find("gonio/acquisition/") == std::string::npos) {
    return load_reflectance_spectra(file);
  }
  std::vector<ReflectanceSpectrum> spectra;
  for (AcquiredSpectrum& one : acquire(load_acquisition(file)).spectra) {
    spectra.push_back(std::move(one.spectrum));
  }
  return spectra;
}

/// The plan, with what the command line says instead.
CalibrationPlan make_plan(const CalibrateOptions& options, const Catalog& catalog) {
  CalibrationPlan plan;
  if (options.plan) {
    plan = load_calibration_plan(find_calibration_plan(*options.plan, catalog), catalog);
  } else {
    plan.free = {"theta"};
  }
  if (options.instrument || plan.instrument.empty()) {
    plan.instrument =
        catalog.find(Catalog::Kind::instrument, options.instrument.value_or("paper_setup"));
  }
  if (!options.geometries.empty()) {
    plan.geometries = options.geometries;
  }
  if (!options.free.empty()) {
    plan.free = options.free;
  }
  if (options.relative_to) {
    plan.reference =
        *options.relative_to == "source" ? MirrorReference::source : MirrorReference::receptor;
  }
  return plan;
}

std::vector<MeasuredSample> measured_samples(const CalibrateOptions& options,
                                             const CalibrationPlan& plan, const Catalog& catalog) {
  std::vector<MeasuredSample> measured;
  std::vector<fs::path> alone;
  for (const std::string& text : options.samples) {
    const std::size_t equals = text.find('=');
    const fs::path sample = catalog.find(Catalog::Kind::sample, text.substr(0, equals));
    if (equals == std::string::npos) {
      alone.push_back(sample);
    } else {
      measured.push_back({.sample = sample, .spectra_file = text.substr(equals + 1)});
    }
  }
  if (alone.empty() && options.spectra && !plan.sample.empty()) {
    alone.push_back(plan.sample);
  }
  if (alone.size() != (options.spectra ? 1u : 0u)) {
    throw std::invalid_argument(fmt::format(
        "--sample: expected {}, found {}",
        options.spectra ? "one sample for the spectra" : "SAMPLE=SPECTRA, as no spectra are given",
        alone.size()));
  }
  if (options.spectra) {
    measured.insert(measured.begin(), {.sample = alone.front(), .spectra_file = *options.spectra});
  }
  if (measured.empty()) {
    throw std::invalid_argument("expected spectra, found none");
  }
  for (MeasuredSample& one : measured) {
    one.spectra = load_spectra(one.spectra_file, catalog);
  }
  return measured;
}

/// Leaves those of the geometries alone; all of them if none is named.
void keep_geometries(std::vector<MeasuredSample>& measured,
                     const std::vector<std::string>& geometries) {
  std::set<std::string> found;
  for (MeasuredSample& one : measured) {
    std::erase_if(one.spectra, [&](const ReflectanceSpectrum& spectrum) {
      found.insert(spectrum.geometry);
      return !geometries.empty() &&
             std::ranges::find(geometries, spectrum.geometry) == geometries.end();
    });
  }
  for (const std::string& geometry : geometries) {
    if (!found.contains(geometry)) {
      throw std::invalid_argument(
          fmt::format("--geometry: expected one that was measured, found '{}'", geometry));
    }
  }
}

std::vector<CalibrationSpectrum> load_samples(const std::vector<MeasuredSample>& measured) {
  std::vector<ReflectanceSpectrum> all;
  for (const MeasuredSample& one : measured) {
    all.insert(all.end(), one.spectra.begin(), one.spectra.end());
  }
  const WavelengthGrid grid = calibration_grid(all);
  std::vector<CalibrationSpectrum> spectra;
  for (const MeasuredSample& one : measured) {
    const SampleFamily family = SampleFamily::load(one.sample, grid);
    for (const ReflectanceSpectrum& spectrum : one.spectra) {
      spectra.push_back({.sample = family, .spectrum = spectrum});
    }
  }
  return spectra;
}

std::vector<std::string> geometries_of(const std::vector<CalibrationSpectrum>& spectra) {
  std::vector<std::string> ids;
  for (const CalibrationSpectrum& one : spectra) {
    if (std::ranges::find(ids, one.spectrum.geometry) == ids.end()) {
      ids.push_back(one.spectrum.geometry);
    }
  }
  return ids;
}

SetupGrid grid_of(const SetupModel& model, const CalibrationPlan& plan) {
  const GridAxes axes =
      plan.grid.sources.empty()
          ? usual_grid(model.instrument(), model.spectra().front().spectrum.geometry)
          : plan.grid;
  Progress progress(size_of(axes), "set-ups");
  return try_grid(model, axes, plan.patches, [&] { progress.advance(); });
}

/// Where a search from the best of a grid begins.
Eigen::VectorXd start_of(const SetupModel& model, const GridRow& row) {
  Eigen::VectorXd start = model.assumed();
  for (std::size_t i = 0; i < model.parameters().size(); ++i) {
    const SetupParameter& parameter = model.parameters()[i];
    double& value = start(Eigen::Index(i));
    if (parameter.kind == SetupParameter::Kind::theta) {
      value += row.angle_offset.degrees();
    }
    if (parameter.kind != SetupParameter::Kind::quantity) {
      continue;
    }
    switch (parameter.quantity) {
      case SetupQuantity::theta_i:
      case SetupQuantity::theta_r:
        value += row.angle_offset.degrees();
        break;
      case SetupQuantity::source_diameter:
        value = row.source.degrees();
        break;
      case SetupQuantity::receptor_diameter:
        value = row.receptor.degrees();
        break;
      default:
        break;
    }
  }
  return start;
}

/// From the set-up as built, and from the best of the grid.
SearchedSetup searched(const SetupModel& model, const std::optional<SetupGrid>& grid) {
  std::vector<Eigen::VectorXd> starts{model.assumed()};
  if (grid) {
    const Eigen::VectorXd start = start_of(model, grid->best(std::nullopt));
    if (start != starts.front() && model(start).allFinite()) {
      starts.push_back(start);
    }
  }
  return search_setup(model, starts);
}

void write_calibration(const CalibrateOptions& options, const CalibrationReport& report,
                       const Instrument& calibrated) {
  const std::string page = options.report ? calibration_page(report) : "";
  if (options.write_instrument) {
    const std::string notes = fmt::format(
        "Set-up of {} as calibrated by gonio {} with spectra of {}; uncertainties are k = 2. What "
        "else that file states is not repeated here.",
        report.instrument, report.version, fmt::join(report.measured, "; "));
    const std::string id = (report.instrument + "_calibrated").substr(0, 64);
    write_text_file(*options.write_instrument, instrument_yaml(calibrated, id, notes));
  }
  if (options.report) {
    const fs::path folder = *options.report;
    fs::create_directories(folder);
    write_text_file(folder / "calibration.html", page);
    write_text_file(folder / "calibration.json", calibration_json(report));
    write_text_file(folder / "calibration.txt", calibration_text(report, false));
  }
}

void calibrate(const CalibrateOptions& options, const CommonOptions& common) {
  const Catalog catalog = common.catalog();
  const CalibrationPlan plan = make_plan(options, catalog);
  const Instrument instrument = load_instrument(plan.instrument, catalog);
  std::vector<MeasuredSample> measured = measured_samples(options, plan, catalog);
  keep_geometries(measured, plan.geometries);
  const std::vector<CalibrationSpectrum> spectra = load_samples(measured);
  const std::vector<std::string> geometries = geometries_of(spectra);
  const SetupModel without(instrument, spectra, {}, plan.reference,
                           std::make_shared<ApertureIntegrator>());
  const SetupModel model(instrument, spectra, setup_parameters(instrument, geometries, plan.free),
                         plan.reference, std::make_shared<ApertureIntegrator>());
  CalibrationReport report{
      .instrument = instrument.id, .reference = plan.reference, .version = GONIO_VERSION};
  for (const MeasuredSample& one : measured) {
    report.measured.push_back(
        fmt::format("{} from {}", one.sample.stem().string(), one.spectra_file));
  }
  Instrument calibrated = instrument;
  if (options.method != "fit") {
    report.grid = grid_of(without, plan);
    calibrated = with_setup(instrument, geometries, report.grid->best());
  }
  if (options.method != "grid") {
    SearchedSetup found = searched(model, report.grid);
    report.fit = std::move(found.best);
    report.others = std::move(found.others);
    calibrated = report.fit->instrument;
  }
  write_calibration(options, report, calibrated);
  print(options.format == "json" ? calibration_json(report)
                                 : calibration_text(report, isatty(STDOUT_FILENO) != 0));
}

void add_calibrate_inputs(CLI::App& command, CalibrateOptions& options) {
  command.add_option("spectra", options.spectra,
                     "Measured spectra: CSV, a file of schema gonio/acquisition/1, or the id of a "
                     "shipped one");
  command
      .add_option("--sample", options.samples,
                  "What was measured: a file or an id; with =SPECTRA behind it, one more sample "
                  "with spectra of its own")
      ->allow_extra_args(false);
  command.add_option("--instrument", options.instrument,
                     "The set-up to be calibrated: a file or an id; paper_setup if not given");
  command
      .add_option("--geometry", options.geometries,
                  "A geometry, e.g. 60; all that were measured if none is given")
      ->allow_extra_args(false);
  command.add_option("--plan", options.plan,
                     "Instrument, sample, grid and parameters: a file of schema "
                     "gonio/calibration/1, or a shipped id, e.g. paper_7_1");
}

}  // namespace

void add_calibrate_command(CLI::App& program, const CommonOptions& common) {
  CLI::App* command = program.add_subcommand(
      "calibrate", "Angles and apertures of a set-up from reflectance spectra of known samples");
  const auto options = std::make_shared<CalibrateOptions>();
  add_calibrate_inputs(*command, *options);
  command
      ->add_option(
          "--free", options->free,
          "What the fit may change, commas between: theta_i, theta_r, theta (both alike), "
          "source, receptor, scale, index; of one geometry as theta_i:60; theta if not given")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--relative-to", options->relative_to,
                   "The mirror of the spectra: all light of the source, or what comes to the same "
                   "receptor; source if not given")
      ->check(CLI::IsMember({"source", "receptor"}));
  command->add_option("--method", options->method, "How set-ups are found")
      ->check(CLI::IsMember({"grid", "fit", "both"}))
      ->capture_default_str();
  command->add_option("--format", options->format, "How results are printed")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  command->add_option("--report", options->report,
                      "Folder for calibration.html, calibration.json and calibration.txt");
  command->add_option("--write-instrument", options->write_instrument,
                      "File for the instrument with the set-up that was found");
  command->footer("Example: gonio calibrate black_glass_spectra --plan paper_7_1");
  command->callback([options, &common] { calibrate(*options, common); });
}

}  // namespace gonio::app
