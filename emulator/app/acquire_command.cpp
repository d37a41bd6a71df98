#include <unistd.h>

#include <memory>
#include <optional>

#include "emulator/app/command.hpp"
#include "emulator/core/text_file.hpp"
#include "emulator/goniometry/acquisition.hpp"
#include "reports/acquisition_report.hpp"

namespace gonio::app {

namespace {

namespace fs = std::filesystem;

struct AcquireOptions {
  std::string acquisition;
  std::optional<std::string> output;
  std::string format = "text";
  std::optional<std::string> report;
};

void write_acquired(const AcquireOptions& options, const AcquisitionResult& result) {
  const std::string page = options.report ? acquisition_page(result, GONIO_VERSION) : "";
  if (options.output) {
    write_text_file(*options.output, acquisition_csv(result));
  }
  if (options.report) {
    const fs::path folder = *options.report;
    fs::create_directories(folder);
    write_text_file(folder / "acquisition.html", page);
    write_text_file(folder / "acquisition.json", acquisition_json(result));
    write_text_file(folder / "acquisition.txt", acquisition_text(result, false));
    write_text_file(folder / "spectra.csv", acquisition_csv(result));
  }
}

void acquire_spectra(const AcquireOptions& options, const CommonOptions& common) {
  const AcquisitionResult result =
      acquire(load_acquisition(find_acquisition(options.acquisition, common.catalog())));
  write_acquired(options, result);
  print(options.format == "json"  ? acquisition_json(result)
        : options.format == "csv" ? acquisition_csv(result)
                                  : acquisition_text(result, isatty(STDOUT_FILENO) != 0));
}

}  // namespace

void add_acquire_command(CLI::App& program, const CommonOptions& common) {
  CLI::App* command = program.add_subcommand(
      "acquire", "Reflectance spectra from what a spectrometer counted: sample, mirror and dark");
  const auto options = std::make_shared<AcquireOptions>();
  command
      ->add_option(
          "acquisition", options->acquisition,
          "What was measured: a file of schema gonio/acquisition/1, or the id of a shipped one")
      ->required();
  command->add_option("--output", options->output,
                      "CSV file for the spectra, which calibrate and fit read");
  add_format_option(*command, options->format);
  command->add_option("--report", options->report,
                      "Folder for acquisition.html, acquisition.json, acquisition.txt and "
                      "spectra.csv");
  command->footer("Example: gonio acquire black_glass_spectra");
  command->callback([options, &common] { acquire_spectra(*options, common); });
}

}  // namespace gonio::app
