#include "emulator/procedure/tile_readings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/unit/message_of.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

using testing::EndsWith;
using testing::SizeIs;

constexpr std::string_view header = "sample,geometry,gloss_gu,expanded_uncertainty_gu\n";

std::vector<TileReading> readings_in(std::string_view text) {
  const test::TemporaryFolder folder;
  return load_tile_readings(folder.file("tiles.csv", text));
}

/// What the reader says of a file, after the file's name; "no error" if nothing.
std::string refusal_of(std::string_view text) {
  const std::string message = test::message_of([&] { (void)readings_in(text); });
  const std::string_view file = "tiles.csv:";
  const std::size_t found = message.find(file);
  return found == std::string::npos ? message : message.substr(found + file.size());
}

TEST(TileReadings, AreThoseOfTheRows) {
  const auto readings = readings_in(std::string(header) +
                                    "# lapped in May\n"
                                    "black_matt,60,12.3,0.4\n"
                                    "tiles/mine.yaml,85,-0.1,\n");
  ASSERT_THAT(readings, SizeIs(2));
  EXPECT_EQ(readings[0].sample, "black_matt");
  EXPECT_EQ(readings[0].geometry, "60");
  EXPECT_EQ(readings[0].gloss_gu, 12.3);
  EXPECT_EQ(readings[0].expanded_uncertainty_gu, 0.4);
  EXPECT_EQ(readings[1].sample, "tiles/mine.yaml");
  EXPECT_EQ(readings[1].gloss_gu, -0.1);
  EXPECT_EQ(readings[1].expanded_uncertainty_gu, std::nullopt);
}

TEST(TileReadings, KnowTheirPlaces) {
  const auto readings = readings_in(std::string(header) + "\n black_matt, 60,12.3,0.4\n");
  EXPECT_THAT(readings[0].mark.text(), EndsWith("tiles.csv:3:2: sample"));
  EXPECT_THAT(readings[0].geometry_mark.text(), EndsWith("tiles.csv:3:14: geometry"));
}

TEST(TileReadings, MayLeaveOutTheUncertainty) {
  const auto readings = readings_in("sample,geometry,gloss_gu\nblack_matt,60,12.3\n");
  EXPECT_EQ(readings.at(0).expanded_uncertainty_gu, std::nullopt);
}

TEST(TileReadings, MayHaveTheirColumnsInAnyOrder) {
  const auto readings = readings_in("gloss_gu,sample,geometry\n12.3,black_matt,60\n");
  EXPECT_EQ(readings.at(0).sample, "black_matt");
  EXPECT_EQ(readings.at(0).gloss_gu, 12.3);
}

TEST(TileReadings, MayBeRepeated) {
  EXPECT_THAT(readings_in(std::string(header) + "a,60,12.3,0.4\na,60,12.3,0.4\n"), SizeIs(2));
}

TEST(TileReadings, MayComeFromASpreadsheet) {
  const auto readings = readings_in("\xEF\xBB\xBFsample,geometry,gloss_gu\r\na,60,12.3\r\n");
  ASSERT_THAT(readings, SizeIs(1));
  EXPECT_EQ(readings[0].gloss_gu, 12.3);
}

struct Refusal {
  const char* name;
  std::string text;
  const char* says;
};

std::string rows(const char* text) { return std::string(header) + text; }

const std::vector<Refusal> refusals{
    {"EmptyFile", "", " expected a file with content, found 'an empty file'"},
    {"CommentsOnly", "# nothing yet\n", " expected a header and readings, found 'none'"},
    {"HeaderOnly", std::string(header), " expected readings, found 'none'"},
    {"NoHeader", "black_matt,60,12.3\n",
     "1:1: expected one of the columns sample, geometry, gloss_gu, expanded_uncertainty_gu, found "
     "'black_matt'"},
    {"MissingColumn", "sample,gloss_gu\na,12.3\n",
     "1:1: expected a column geometry, found nothing"},
    {"UnknownColumn", "sample,geometry,gloss\n",
     "1:17: expected one of the columns sample, geometry, gloss_gu, expanded_uncertainty_gu, found "
     "'gloss'"},
    {"EmptyColumnName", "sample,geometry,gloss_gu,\n",
     "1:26: expected one of the columns sample, geometry, gloss_gu, expanded_uncertainty_gu, found "
     "nothing"},
    {"ColumnTwice", "sample,geometry,sample\n",
     "1:17: expected each column once, found 'sample a second time'"},
    {"Semicolons", "sample;geometry;gloss_gu\n",
     "1:1: expected one of the columns sample, geometry, gloss_gu, expanded_uncertainty_gu, found "
     "'sample;geometry;gloss_gu'"},
    {"ShortRow", rows("a,60,12.3\n"), "2:6: expected 4 cells, found '3 cells'"},
    {"LongRow", rows("a,60,12,3,0.4\n"), "2:11: expected 4 cells, found '5 cells'"},
    {"NoSample", rows(",60,12.3,0.4\n"),
     "2:1: sample: expected a file or an id of a sample, found nothing"},
    {"NoGeometry", rows("a, ,12.3,0.4\n"),
     "2:3: geometry: expected the id of a geometry, found nothing"},
    {"NoGloss", rows("a,60,,0.4\n"), "2:6: gloss_gu: expected a number, found nothing"},
    {"WrongNumber", rows("a,60,12.3.4,0.4\n"), "2:6: gloss_gu: expected a number, found '12.3.4'"},
    {"Unit", rows("a,60,12.3 GU,0.4\n"), "2:6: gloss_gu: expected a number, found '12.3 GU'"},
    {"NotANumber", rows("a,60,nan,0.4\n"), "2:6: gloss_gu: expected a number, found 'nan'"},
    {"Infinity", rows("a,60,inf,0.4\n"), "2:6: gloss_gu: expected a number, found 'inf'"},
    {"NegativeUncertainty", rows("a,60,12.3,0.4\na,60,12.3,-0.4\n"),
     "3:11: expanded_uncertainty_gu: expected a number > 0, found '-0.4'"},
    {"NoUncertaintyAtAll", rows("a,60,12.3,0\n"),
     "2:11: expanded_uncertainty_gu: expected a number > 0, found '0'"},
};

class TileReadingsRefusal : public testing::TestWithParam<Refusal> {};

TEST_P(TileReadingsRefusal, SaysWhereAndWhy) {
  EXPECT_EQ(refusal_of(GetParam().text), GetParam().says);
}

INSTANTIATE_TEST_SUITE_P(Of, TileReadingsRefusal, testing::ValuesIn(refusals),
                         [](const auto& refusal) { return std::string(refusal.param.name); });

TEST(TileReadings, NeedAFile) {
  EXPECT_THAT(test::message_of([] { (void)load_tile_readings("/nowhere/tiles.csv"); }),
              EndsWith("tiles.csv: expected a file, found nothing"));
}

}  // namespace
}  // namespace gonio
