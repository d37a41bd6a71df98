#include <memory>

#include "emulator/app/qa_options.hpp"

namespace gonio::app {

namespace {

void add_store_option(CLI::App& command, QaOptions& options) {
  command
      .add_option("--store", options.store,
                  "Where runs are kept: sqlite:FILE, or postgresql://HOST/DATABASE")
      ->capture_default_str();
}

void add_run_options(CLI::App& command, QaOptions& options) {
  command.add_option("batch", options.batch, "A batch: a file or an id");
  add_store_option(command, options);
  command.add_option("--readings", options.readings,
                     "Measured readings to judge in place of simulated ones: CSV or tab-separated, "
                     "columns as the batch file says");
  command.add_flag("--resume", options.resume, "Go on with the run of this batch that was stopped");
  command.add_option("--seed", options.seed, "In place of the batch's")
      ->check(CLI::Range(std::uint64_t(0), std::uint64_t(1'000'000'000)));
  command
      .add_option("--risk-lots", options.risk_lots,
                  "Lots that are simulated to tell risks, for each point of a curve; 0: none")
      ->check(CLI::Range(std::uint64_t(0), std::uint64_t(10'000'000)));
  add_format_option(command, options.format);
  command.add_option("--report", options.report,
                     "Folder for qa.html, qa.json, qa.txt and readings.csv");
}

void add_history(CLI::App& qa, QaOptions& options, ExitStatus& status) {
  CLI::App* command = qa.add_subcommand("history", "Trends and control charts over runs");
  add_store_option(*command, options);
  command->add_option("--batch", options.of_batch, "The runs of one batch, by its id");
  add_format_option(*command, options.format);
  command->add_option("--report", options.report, "Folder for history.html and history.json");
  command->footer("Example: gonio qa history --store sqlite:qa.db");
  command->callback([&] { status = run_qa_history(options); });
}

void add_export(CLI::App& qa, QaOptions& options, ExitStatus& status) {
  CLI::App* command = qa.add_subcommand("export", "All readings of a run");
  command->add_option("run", options.run, "Its number, see `gonio qa history`")->required();
  add_store_option(*command, options);
  command->add_option("--format", options.format, "How readings are written")
      ->check(CLI::IsMember({"csv", "json"}));
  command->add_option("--output", options.output, "File; standard output if not given");
  command->footer("Example: gonio qa export 1 --format csv");
  command->callback([&] { status = run_qa_export(options); });
}

void add_verify(CLI::App& qa, QaOptions& options, const CommonOptions& common, ExitStatus& status) {
  CLI::App* command =
      qa.add_subcommand("verify", "Compute a simulated run again and compare it, bit for bit");
  command->add_option("run", options.run, "Its number, see `gonio qa history`")->required();
  add_store_option(*command, options);
  command->footer("Example: gonio qa verify 1");
  command->callback([&] { status = run_qa_verify(options, common); });
}

}  // namespace

void add_qa_command(CLI::App& program, const CommonOptions& common, ExitStatus& status) {
  CLI::App* command = program.add_subcommand(
      "qa", "Batches of a product: what a plan decides of them, and how often it is wrong");
  const auto options = std::make_shared<QaOptions>();
  add_run_options(*command, *options);
  command->require_subcommand(0, 1);
  add_history(*command, *options, status);
  add_export(*command, *options, status);
  add_verify(*command, *options, common, status);
  command->footer(
      "Example: gonio qa coil_coating_60 --store sqlite:qa.db --report report\n"
      "Exit status: 0 the batch passes, 1 it fails or that cannot be told");
  command->callback([command, options, &common, &status] {
    if (!command->get_subcommands().empty()) {
      return;
    }
    if (!options->batch) {
      throw CLI::RequiredError("batch");
    }
    status = run_qa(*options, common);
  });
}

}  // namespace gonio::app
