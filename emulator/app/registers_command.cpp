#include <memory>
#include <string>
#include <vector>

#include "emulator/app/command.hpp"
#include "emulator/protocol/register_map_documents.hpp"
#include "emulator/protocol/register_map_exports.hpp"

namespace gonio::app {

namespace {

struct Format {
  const char* name;
  std::string (*write)(const RegisterMap&);
};

constexpr Format formats[] = {{"page", register_page},
                              {"csv", register_csv},
                              {"openmodbus", openmodbus_yaml},
                              {"telegraf", telegraf_toml},
                              {"home_assistant", home_assistant_yaml}};

void run_registers(const std::string& name) {
  for (const Format& format : formats) {
    if (format.name == name) {
      print(format.write(RegisterMap::standard()));
    }
  }
}

}  // namespace

void add_registers_command(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("registers", "The Modbus register map, for people and for clients");
  const auto format = std::make_shared<std::string>("page");
  std::vector<std::string> names;
  for (const Format& known : formats) {
    names.emplace_back(known.name);
  }
  command->add_option("--format", *format, "A page in Markdown, or what a client reads")
      ->check(CLI::IsMember(names))
      ->capture_default_str();
  command->footer("Example: gonio registers --format telegraf");
  command->callback([format] { run_registers(*format); });
}

}  // namespace gonio::app
