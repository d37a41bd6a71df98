#include "emulator/protocol/register_map.hpp"

#include <gmock/gmock.h>

#include <set>
#include <string>

#include "tests/unit/message_of.hpp"

namespace gonio {
namespace {

using modbus::Table;
using test::message_of;
using testing::HasSubstr;

std::string map_text(const std::string& blocks) {
  return "schema: gonio/register_map/1\nversion: 1\ntitle: Mine\nblocks:\n" + blocks;
}

RegisterMap read(const std::string& blocks) {
  return read_register_map(YamlNode::parse(map_text(blocks), "mine.yaml"));
}

/// A block around points, which begin at line 9.
std::string block(const std::string& points, const std::string& rest = "") {
  return "  - id: b\n    title: B\n    table: holding_registers\n    address: 10\n" + rest +
         "    points:\n" + points;
}

std::string error(const std::string& blocks) {
  return message_of([&] { (void)read(blocks); });
}

TEST(StandardRegisterMap, UsesEveryAddressOnceOverAllTables) {
  std::set<int> used;
  for (const Block& block : RegisterMap::standard().blocks) {
    for (const Point& point : block.points) {
      for (int address = point.address; address <= point.last_address(); ++address) {
        EXPECT_TRUE(used.insert(address).second) << point.id << " at " << address;
      }
    }
  }
}

TEST(StandardRegisterMap, TellsTheMeaningOfEveryPointAndSymbol) {
  for (const Block& block : RegisterMap::standard().blocks) {
    EXPECT_FALSE(block.title.empty()) << block.id;
    for (const Point& point : block.points) {
      EXPECT_FALSE(point.meaning.empty()) << point.id;
      EXPECT_EQ(point.value.empty(), point.constant.has_value()) << point.id;
      for (const Symbol& symbol : point.symbols) {
        EXPECT_FALSE(symbol.meaning.empty()) << point.id << "." << symbol.name;
      }
    }
  }
}

TEST(StandardRegisterMap, HasTheSnapshotInOneRequest) {
  const RegisterMap& map = RegisterMap::standard();
  int next = 0;
  for (const char* id : {"status", "readings", "statistics", "scaled", "cdab"}) {
    for (const Block& block : map.blocks) {
      if (block.id == id) {
        EXPECT_EQ(block.points.front().address, next) << id;
        EXPECT_EQ(block.points.front().table, Table::input_registers);
        next = block.points.back().last_address() + 1;
      }
    }
  }
  EXPECT_EQ(next, 114);  // as its conventions say; a request can read 125
}

TEST(StandardRegisterMap, StatesTheLengthOfItsSunSpecModels) {
  const RegisterMap& map = RegisterMap::standard();
  const auto length = [&](const char* length_id, const char* next_id) {
    const Point* length_point = map.find(length_id);
    EXPECT_EQ(std::stoi(*length_point->constant),
              map.find(next_id)->address - length_point->address - 1);
  };
  length("sunspec_common_length", "gloss_model_id");
  length("gloss_model_length", "sunspec_end");
  EXPECT_EQ(map.find("sunspec_marker")->address, 40000);
  EXPECT_EQ(map.find("sunspec_common_length")->constant, "66");
}

TEST(Point, HasTheReferenceNumberOfOld) {
  const RegisterMap& map = RegisterMap::standard();
  EXPECT_EQ(map.find("run_measure")->reference_number(), 2001);
  EXPECT_EQ(map.find("ready")->reference_number(), 13001);
  EXPECT_EQ(map.find("status")->reference_number(), 30001);
  EXPECT_EQ(map.find("command")->reference_number(), 41001);
  EXPECT_EQ(map.find("sunspec_marker")->reference_number(), 440001);
}

TEST(RegisterMapReader, GivesPointsTheNextFreeRegister) {
  const RegisterMap map =
      read(block("      - {id: a, type: uint32, meaning: A}\n"
                 "      - {skip: 3}\n"
                 "      - {id: c, type: int16, scale: 0.1, each_channel: true, meaning: C}\n"
                 "      - {id: t, type: text, registers: 2, constant: abc, meaning: T}\n",
                 "    word_order: CDAB\n"));
  EXPECT_EQ(map.find("a")->address, 10);
  EXPECT_TRUE(map.find("a")->is_word_swapped);
  EXPECT_EQ(map.find("c_1")->address, 15);
  EXPECT_EQ(map.find("c_3")->address, 17);
  EXPECT_EQ(map.find("c_3")->channel, 2);
  EXPECT_EQ(map.find("c_3")->value, "c");
  EXPECT_EQ(map.find("t")->last_address(), 19);
  EXPECT_EQ(map.find("c"), nullptr);
}

TEST(RegisterMapReader, MakesBitsOfABitField) {
  const RegisterMap map = read(block("      - id: field\n        type: uint16\n        meaning: F\n"
                                     "        bits: [{bit: 1, name: one, meaning: One}, {bit: 4, "
                                     "name: four, meaning: Four}]\n") +
                               "  - {id: bits, title: Bits, table: discrete_inputs, address: 100, "
                               "points: [{bits_of: field}]}\n");
  EXPECT_EQ(map.find("one")->address, 101);
  EXPECT_EQ(map.find("four")->address, 104);
  EXPECT_EQ(map.find("four")->meaning, "Four");
  EXPECT_EQ(map.find("four")->type, PointType::boolean);
}

TEST(RegisterMapReader, RefusesPointsThatOverlapInWhateverTable) {
  EXPECT_THAT(error(block("      - {id: a, type: uint32, meaning: A}\n") +
                    "  - id: c\n    title: C\n    table: coils\n    address: 11\n    points:\n"
                    "      - {id: d, type: boolean, meaning: D}\n"),
              HasSubstr("mine.yaml:16:14: blocks[1].points[0].id: expected an address that 'a' "
                        "does not use, found '11'"));
}

TEST(RegisterMapReader, RefusesWhatTheSchemaDoesNotKnow) {
  EXPECT_THAT(error(block("      - {id: a, type: float64, meaning: A}\n")),
              HasSubstr("type: expected int16, uint16, int32, uint32, float32 or text, found "
                        "'float64'"));
  EXPECT_THAT(error(block("      - {id: a, type: boolean, meaning: A}\n")), HasSubstr("'boolean'"));
  EXPECT_THAT(error(block("      - {id: a, type: int16}\n")), HasSubstr("meaning"));
  EXPECT_THAT(error(block("      - {id: a, type: int16, meaning: A, colour: red}\n")),
              HasSubstr("colour"));
  EXPECT_THAT(error(block("      - {id: a, type: uint32, scale: 0.1, meaning: A}\n")),
              HasSubstr("no scale"));
  EXPECT_THAT(error(block("      - {id: a, type: text, meaning: A}\n")), HasSubstr("registers"));
}

TEST(RegisterMapReader, RefusesIdsThatAreUsedTwice) {
  EXPECT_THAT(error(block("      - {id: a, type: int16, meaning: A}\n"
                          "      - {id: a, type: int16, meaning: A}\n")),
              HasSubstr("expected an id that no other point has, found 'a'"));
  const std::string one = block("      - {id: a, type: int16, meaning: A}\n");
  EXPECT_THAT(error(one + one), HasSubstr("expected an id that no other block has"));
}

TEST(RegisterMapReader, RefusesAddressesBeyondTheLast) {
  const std::string text =
      "  - {id: b, title: B, table: holding_registers, address: 65535, points: [{id: a, type: ";
  EXPECT_EQ(read(text + "int16, meaning: A}]}\n").find("a")->address, 65535);
  EXPECT_THAT(error(text + "int32, meaning: A}]}\n"),
              HasSubstr("expected addresses up to 65535, found '65536'"));
}

TEST(RegisterMapReader, RefusesSymbolsThatCannotBeToldApart) {
  EXPECT_THAT(error(block("      - {id: a, type: int16, meaning: A, symbols: [{value: 0, name: x, "
                          "meaning: X}, {value: 0, name: y, meaning: Y}]}\n")),
              HasSubstr("another value and name than those of 'x'"));
  EXPECT_THAT(error(block("      - {id: a, type: uint16, meaning: A, bits: [{bit: 16, name: x, "
                          "meaning: X}]}\n")),
              HasSubstr("a whole number in [0, 15]"));
  EXPECT_THAT(error(block("      - {id: a, type: int16, meaning: A, symbols_of: z}\n")),
              HasSubstr("the id of a point above"));
}

TEST(RegisterMapReader, RefusesConstantsThatDoNotFit) {
  EXPECT_THAT(
      error(block("      - {id: a, type: text, registers: 1, constant: abc, meaning: A}\n")),
      HasSubstr("up to 2 characters"));
  EXPECT_THAT(error(block("      - {id: a, type: int16, constant: abc, meaning: A}\n")),
              HasSubstr("expected a number"));
  EXPECT_THAT(error(block("      - {id: a, type: int16, constant: 1, value: b, meaning: A}\n")),
              HasSubstr("no constant beside value or writable"));
}

TEST(RegisterMapReader, RefusesToWriteWhereNothingCanBeWritten) {
  EXPECT_THAT(error("  - {id: b, title: B, table: input_registers, address: 0, points: [{id: a, "
                    "type: int16, writable: true, meaning: A}]}\n"),
              HasSubstr("nothing writable"));
}

}  // namespace
}  // namespace gonio
