#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "emulator/app/command.hpp"
#include "emulator/core/csv_cell.hpp"
#include "emulator/core/yaml_map.hpp"

namespace gonio::app {

namespace {

struct ListArguments {
  std::string what;
  std::string format = "text";
};

struct Row {
  std::string id, title, file;
};

Row read_row(const Catalog::Entry& entry) {
  return YamlNode::load(entry.file).read_map([&](YamlMap& map) {
    map.ignore_others();
    return Row{entry.id, map.required("title").line(), entry.file.string()};
  });
}

std::string table(const std::vector<Row>& rows, const ListArguments& options) {
  std::string text = options.format == "csv" ? "id,title,file\n" : "";
  std::size_t width = 0;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Row& row : rows) {
    width = std::max(width, row.id.size());
    list.push_back({{"id", row.id}, {"title", row.title}, {"file", row.file}});
  }
  if (options.format == "json") {
    using nlohmann::ordered_json;
    return ordered_json{{"schema", "gonio/list/1"}, {options.what, list}}.dump(
               1, ' ', false, ordered_json::error_handler_t::replace) +
           "\n";
  }
  for (const Row& row : rows) {
    text += options.format == "csv" ? fmt::format("{},{},{}\n", csv_cell(row.id),
                                                  csv_cell(row.title), csv_cell(row.file))
                                    : fmt::format("{:<{}}  {}\n", row.id, width, row.title);
  }
  return text;
}

void run_list(const ListArguments& options, const CommonOptions& common) {
  const Catalog::Kind kind = options.what == "standards" ? Catalog::Kind::standard
                             : options.what == "samples" ? Catalog::Kind::sample
                             : options.what == "batches" ? Catalog::Kind::batch
                                                         : Catalog::Kind::instrument;
  std::vector<Row> rows;
  for (const Catalog::Entry& entry : common.catalog().list(kind)) {
    rows.push_back(read_row(entry));
  }
  print(table(rows, options));
}

}  // namespace

void add_list_command(CLI::App& program, const CommonOptions& common) {
  CLI::App* command = program.add_subcommand("list", "What there is to measure, and to measure by");
  const auto options = std::make_shared<ListArguments>();
  command->add_option("what", options->what, "standards, samples, instruments or batches")
      ->required()
      ->check(CLI::IsMember({"standards", "samples", "instruments", "batches"}));
  add_format_option(*command, options->format);
  command->footer("Example: gonio list standards");
  command->callback([options, &common] { run_list(*options, common); });
}

}  // namespace gonio::app
