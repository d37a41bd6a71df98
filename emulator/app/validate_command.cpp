#include <unistd.h>

#include <memory>
#include <optional>
#include <string>

#include "emulator/app/bars.hpp"
#include "emulator/app/command.hpp"
#include "emulator/core/text_file.hpp"
#include "emulator/goniometry/validation.hpp"
#include "reports/validation_report.hpp"

namespace gonio::app {

namespace {

namespace fs = std::filesystem;

struct ValidateOptions {
  std::optional<std::string> plan;
  std::string format = "text";
  std::optional<std::string> report;
};

/// Everything is made before anything is written: who interrupts finds nothing half done.
void write_validation(const fs::path& folder, const ValidationPlan& plan,
                      const ValidationResult& result) {
  const std::string page = validation_page(plan, result);
  fs::create_directories(folder);
  write_text_file(folder / "validation.html", page);
  write_text_file(folder / "validation.json", validation_json(plan, result));
  write_text_file(folder / "validation.csv", validation_csv(plan, result));
  write_text_file(folder / "validation.txt", validation_text(plan, result, false));
}

void validate_by(const ValidateOptions& options, const CommonOptions& common) {
  const Catalog catalog = common.catalog();
  const ValidationPlan plan = load_validation_plan(
      options.plan ? fs::path(*options.plan) : catalog.fixture("validation/mihalik.yaml"), catalog);
  ValidationResult result;
  {
    Bars bars;
    result = validate(plan, [&](std::size_t done, std::size_t total) {
      bars.show("spectra", done, total);
    });
  }
  if (options.report) {
    write_validation(*options.report, plan, result);
  }
  if (options.format == "json") {
    print(validation_json(plan, result));
  } else if (options.format == "csv") {
    print(validation_csv(plan, result));
  } else {
    print(validation_text(plan, result, isatty(STDOUT_FILENO) != 0));
  }
}

}  // namespace

void add_validate_command(CLI::App& program, const CommonOptions& common) {
  CLI::App* command = program.add_subcommand(
      "validate", "The printed results of a publication beside the same computed here");
  const auto options = std::make_shared<ValidateOptions>();
  command->add_option("plan", options->plan,
                      "Validation file; that of Mihalik and Durikovic if not given");
  add_format_option(*command, options->format);
  command->add_option("--report", options->report,
                      "Folder for validation.html, .json, .csv and .txt; needs gnuplot");
  command->footer("Example: gonio validate --format csv");
  command->callback([options, &common] { validate_by(*options, common); });
}

}  // namespace gonio::app
