#include "emulator/protocol/register_map_documents.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <string>

#include "emulator/core/text_file.hpp"
#include "emulator/protocol/register_map_exports.hpp"

namespace gonio {
namespace {

using testing::HasSubstr;
using testing::Not;

// What is printed against reports/registers/; UPDATE_REFERENCE=1 rewrites the files.

struct File {
  const char* name;
  std::string (*write)(const RegisterMap&);
};

class RegisterMapFiles : public testing::TestWithParam<File> {};

TEST_P(RegisterMapFiles, AreNotStale) {
  const std::filesystem::path file =
      std::filesystem::path(GONIO_SOURCE_DIR) / "reports/registers" / GetParam().name;
  const std::string current = GetParam().write(RegisterMap::standard());
  if (const char* update = std::getenv("UPDATE_REFERENCE");
      update != nullptr && std::string(update) == "1") {
    write_text_file(file, current);
  }
  EXPECT_TRUE(read_text_file(file) == current) << file << " is not what the writer prints now";
}

INSTANTIATE_TEST_SUITE_P(
    Registers, RegisterMapFiles,
    testing::Values(File{"registers.md", register_page}, File{"registers.csv", register_csv},
                    File{"openmodbus.yaml", openmodbus_yaml}, File{"telegraf.toml", telegraf_toml},
                    File{"home_assistant.yaml", home_assistant_yaml}),
    [](const auto& test) {
      const std::string name = test.param.name;
      return name.substr(0, name.find('.')) + "_" + name.substr(name.find('.') + 1);
    });

TEST(RegisterPage, ShowsAddressAndNumberSideBySide) {
  const std::string page = register_page(RegisterMap::standard());
  EXPECT_THAT(page, HasSubstr("| 18 to 19 | 30019 | `gloss_1` | float32 | GU | read |"));
  EXPECT_THAT(page, HasSubstr("| 1000 | 41001 | `command` | uint16 |  | read, write |"));
  EXPECT_THAT(page, HasSubstr("| 2000 | 02001 | `run_measure` | boolean |"));
  EXPECT_THAT(page, HasSubstr("| 40000 to 40001 | 440001 | `sunspec_marker` | text, 4 characters"));
  EXPECT_THAT(page, HasSubstr("int16, times 0.1"));
}

TEST(RegisterPage, NamesEveryPointSymbolAndConvention) {
  const RegisterMap& map = RegisterMap::standard();
  const std::string page = register_page(map);
  for (const Convention& convention : map.conventions) {
    EXPECT_THAT(page, HasSubstr(convention.rule));
  }
  for (const Block& block : map.blocks) {
    for (const Point& point : block.points) {
      EXPECT_THAT(page, HasSubstr("`" + point.id + "`"));
      for (const Symbol& symbol : point.symbols) {
        EXPECT_THAT(page, HasSubstr(symbol.meaning));
      }
    }
  }
}

TEST(RegisterPage, WritesAListOfSymbolsOnce) {
  const std::string page = register_page(RegisterMap::standard());
  EXPECT_THAT(page, HasSubstr("Symbols of `command` are those of `last_command`."));
  EXPECT_THAT(page, Not(HasSubstr("Symbols of `verdict_2`")));
}

TEST(SymbolList, TellsBitsFromNumbers) {
  const RegisterMap& map = RegisterMap::standard();
  EXPECT_THAT(symbol_list(*map.find("state")), HasSubstr("0 = warm_up, 1 = idle"));
  EXPECT_THAT(symbol_list(*map.find("status")), HasSubstr("bit 0 = ready, bit 1 = busy"));
  EXPECT_EQ(symbol_list(*map.find("sequence")), "");
}

}  // namespace
}  // namespace gonio
