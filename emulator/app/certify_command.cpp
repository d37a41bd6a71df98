#include <fmt/format.h>
#include <unistd.h>

#include <cstdint>
#include <memory>
#include <optional>

#include "emulator/app/bars.hpp"
#include "emulator/app/command.hpp"
#include "emulator/core/text_file.hpp"
#include "emulator/core/today.hpp"
#include "emulator/procedure/certify.hpp"
#include "emulator/procedure/setup_effects.hpp"
#include "reports/certificate_report.hpp"
#include "reports/pdf.hpp"

namespace gonio::app {

namespace {

namespace fs = std::filesystem;

struct CertifyArguments {
  std::string instrument;
  std::optional<std::string> standard;
  std::vector<std::string> geometries;
  std::vector<std::string> samples;
  std::string decision = "guarded";
  double guard_band = 1.0;
  std::optional<std::size_t> trials;
  std::uint64_t seed = 1;
  std::optional<std::string> readings;
  double prior_tolerances = SetupEstimateOptions{}.prior_tolerances;
  std::optional<std::string> laboratory;
  std::string format = "text";
  std::string budgets = "main";
  std::optional<std::string> report;
  std::optional<std::string> pdf;
};

/// What the instrument is judged by: what was asked for, else what it is built to.
fs::path clauses_file(const CertifyArguments& options, const Instrument& instrument,
                      const Catalog& catalog) {
  fs::path beside = instrument.standard.file.parent_path() / "clauses.yaml";
  if (!options.standard && fs::is_regular_file(beside)) {
    return beside;
  }
  return catalog.find(Catalog::Kind::clauses, options.standard.value_or(instrument.standard.id));
}

ClauseSet load_judgement(const fs::path& file, const Catalog& catalog) {
  ClauseSet clauses = load_clauses(file, catalog);
  if (!clauses.standard) {
    throw std::invalid_argument(fmt::format(
        "--standard: expected a standard of glossmeters, found '{}', which measures nothing",
        clauses.id));
  }
  return clauses;
}

std::vector<Sample> ladder(const CertifyArguments& options, const Catalog& catalog,
                           const WavelengthGrid& grid) {
  std::vector<Sample> samples = effect_ladder(grid);
  for (const std::string& sample : options.samples) {
    samples.push_back(load_sample(catalog.find(Catalog::Kind::sample, sample), grid));
  }
  return samples;
}

/// The tile of a reading; if there is none, the reading's place is to blame.
Sample load_tile(const TileReading& reading, const Catalog& catalog, const WavelengthGrid& grid) {
  fs::path file;
  try {
    file = catalog.find(Catalog::Kind::sample, reading.sample);
  } catch (const InputError&) {
    throw InputError(reading.mark, "a sample: a file or an id, see `gonio list samples`",
                     reading.sample);
  }
  return load_sample(file, grid);
}

/// Readings with their tiles.
struct Readings {
  std::vector<TileReading> readings = {};
  std::vector<Sample> tiles = {};
};

Readings load_readings(const CertifyArguments& options, const Catalog& catalog,
                       const WavelengthGrid& grid) {
  Readings loaded;
  if (options.readings) {
    loaded.readings = load_tile_readings(*options.readings);
    for (const TileReading& reading : loaded.readings) {
      loaded.tiles.push_back(load_tile(reading, catalog, grid));
    }
  }
  return loaded;
}

/// What the sources are, from the file that stands above the folders of the standards.
std::map<std::string, std::string> sources_of(const fs::path& clauses) {
  const fs::path file = clauses.parent_path().parent_path().parent_path() / "sources.yaml";
  return fs::is_regular_file(file) ? load_sources(file) : std::map<std::string, std::string>();
}

Certificate make_certificate(const CertifyArguments& options, const Instrument& instrument,
                             const ClauseSet& clauses, const Catalog& catalog) {
  const WavelengthGrid grid = WavelengthGrid::visible();
  const Readings read = load_readings(options, catalog, grid);
  Bars bars;
  const CertifyOptions certify_options{
      .geometries = options.geometries,
      .decision_rule = options.decision == "simple" ? DecisionRule::simple : DecisionRule::guarded,
      .guard_band_factor = options.guard_band,
      .seed = options.seed,
      .trials = options.trials,
      .advance = [&](const char* work, std::size_t done, std::size_t total) {
        bars.show(work, done, total);
      }};
  Certificate certificate =
      certify(instrument, clauses, ladder(options, catalog, grid), certify_options);
  if (options.readings) {
    certificate.estimates = estimate_setup(instrument, read.readings, read.tiles,
                                           {.prior_tolerances = options.prior_tolerances});
  }
  for (CertificateLimit& limit : certificate.limits) {
    limit.limit.mark.file = catalog.name_of(limit.limit.mark.file);
  }
  return certificate;
}

/// Everything is made before anything is written: who interrupts finds nothing half done.
void write_files(const CertifyArguments& options, const CertificateReport& report) {
  if (!options.report && !options.pdf) {
    return;
  }
  const std::string page = certificate_page(report);
  const std::string pdf = options.pdf ? printed_pdf(page) : "";
  if (options.report) {
    const fs::path folder = *options.report;
    fs::create_directories(folder);
    write_text_file(folder / "certificate.html", page);
    write_text_file(folder / "certificate.json", certificate_json(report));
    write_text_file(folder / "certificate.txt", certificate_text(report, false));
  }
  if (options.pdf) {
    write_text_file(*options.pdf, pdf);
  }
}

ExitStatus status_of(ConformanceVerdict verdict) {
  switch (verdict) {
    case ConformanceVerdict::pass:
    case ConformanceVerdict::not_applicable:
      return done;
    case ConformanceVerdict::error:
      return environment_failed;
    default:
      return does_not_conform;
  }
}

ExitStatus run_certify(const CertifyArguments& options, const CommonOptions& common) {
  const Catalog catalog = common.catalog();
  if (options.pdf) {
    (void)pdf_printer();
  }
  const Laboratory laboratory =
      options.laboratory ? load_laboratory(*options.laboratory) : Laboratory();
  const Instrument instrument =
      load_instrument(catalog.find(Catalog::Kind::instrument, options.instrument), catalog);
  expect_gloss(instrument);
  const fs::path file = clauses_file(options, instrument, catalog);
  const Certificate certificate =
      make_certificate(options, instrument, load_judgement(file, catalog), catalog);
  const CertificateReport report{
      .certificate = certificate,
      .laboratory = laboratory,
      .version = GONIO_VERSION,
      .date = today(),
      .sources = sources_of(file),
      .budgets = options.budgets == "all" ? Budgets::all : Budgets::main};
  write_files(options, report);
  print(options.format == "json" ? certificate_json(report)
                                 : certificate_text(report, isatty(STDOUT_FILENO) != 0));
  return status_of(certificate.verdict);
}

void add_calculation_options(CLI::App& command, CertifyArguments& options) {
  command
      .add_option("--decision", options.decision,
                  "How uncertainty is taken into account at a limit")
      ->check(CLI::IsMember({"guarded", "simple"}))
      ->capture_default_str();
  command.add_option("--guard-band", options.guard_band, "Of the guarded decision, in U")
      ->check(number_in(Range::closed(0.0, 10.0)))
      ->capture_default_str();
  command
      .add_option("--trials", options.trials,
                  "Of Monte Carlo; until two digits of u are stable if not given")
      ->check(CLI::Range(std::size_t(1'000), std::size_t(100'000'000)));
  command.add_option("--seed", options.seed, "Of Monte Carlo")
      ->check(CLI::Range(std::uint64_t(0), std::uint64_t(1'000'000'000)))
      ->capture_default_str();
  command.add_option("--readings", options.readings,
                     "CSV of readings of tiles, from which the set-up is estimated: "
                     "sample,geometry,gloss_gu[,expanded_uncertainty_gu]");
  command
      .add_option("--prior-tolerances", options.prior_tolerances,
                  "How far the set-up may be off before readings: standard uncertainty in "
                  "tolerances")
      ->check(number_in(Range::closed(1e-3, 1e3)))
      ->capture_default_str();
}

void add_output_options(CLI::App& command, CertifyArguments& options) {
  command.add_option("--laboratory", options.laboratory,
                     "What the laboratory states on its certificate: a file of schema "
                     "gonio/laboratory/1");
  command.add_option("--format", options.format, "How the certificate is printed")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  command.add_option("--budgets", options.budgets, "Of which samples budgets are shown")
      ->check(CLI::IsMember({"main", "all"}))
      ->capture_default_str();
  command.add_option("--report", options.report,
                     "Folder for certificate.html, certificate.json and certificate.txt");
  command.add_option("--pdf", options.pdf,
                     "File for the certificate as PDF; needs an installed Chromium");
}

}  // namespace

void add_certify_command(CLI::App& program, const CommonOptions& common, ExitStatus& status) {
  CLI::App* command = program.add_subcommand(
      "certify", "Limits of a set-up, what its deviations do to readings, and their uncertainty");
  const auto options = std::make_shared<CertifyArguments>();
  command->add_option("instrument", options->instrument, "An instrument as built: a file or an id")
      ->required();
  command->add_option("--standard", options->standard,
                      "Whose limits; what the instrument is built to if not given");
  command
      ->add_option("--geometry", options->geometries, "A geometry, e.g. 60; all if none is given")
      ->allow_extra_args(false);
  command
      ->add_option("--sample", options->samples,
                   "A sample besides those of the ladder: a file or an id")
      ->allow_extra_args(false);
  add_calculation_options(*command, *options);
  add_output_options(*command, *options);
  command->footer(
      "Example: gonio certify triangle_gloss --standard iso_2813/2014\n"
      "Exit status: 0 all limits are met, 1 not, or too uncertain to tell");
  command->callback([options, &common, &status] { status = run_certify(*options, common); });
}

}  // namespace gonio::app
