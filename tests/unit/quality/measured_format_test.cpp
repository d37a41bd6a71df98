#include "emulator/quality/measured_format.hpp"

#include <gtest/gtest.h>

#include "tests/unit/quality/batch_text.hpp"

namespace gonio {
namespace {

using Names = std::map<std::string, std::string>;

MeasuredFormat read(const std::string& text) {
  return read_measured_format(YamlNode::parse(text, "batch.yaml"));
}

std::string error_of(const std::string& text) {
  return test::message_of([&] { (void)read(text); });
}

TEST(ReadMeasuredFormat, ReadsHowAFileIsWritten) {
  const MeasuredFormat format = read("delimiter: semicolon\ndecimal: comma\n");
  EXPECT_EQ(format.delimiter, ';');
  EXPECT_EQ(format.decimal, ',');
  EXPECT_EQ(read("{delimiter: tab, decimal: point}").delimiter, '\t');
  EXPECT_EQ(read("delimiter: comma").delimiter, ',');
  EXPECT_EQ(read("delimiter: comma").decimal, '.');
  EXPECT_FALSE(read("decimal: comma").delimiter);
  EXPECT_EQ(format.mark.line, 1);
}

TEST(ReadMeasuredFormat, TellsRolesFromChannels) {
  const MeasuredFormat format =
      read("columns: {lot: Charge, panel: No, \"60\": Out, 85 deg: Matt, 60/colour: dE}");
  EXPECT_EQ(format.roles, (Names{{"lot", "Charge"}, {"panel", "No"}}));
  EXPECT_EQ(format.channels, (Names{{"60", "Out"}, {"85", "Matt"}, {"60/colour", "dE"}}));
  const MeasuredFormat by_row = read("columns: {channel: Geometry, value: Gloss}");
  EXPECT_EQ(by_row.roles, (Names{{"channel", "Geometry"}, {"value", "Gloss"}}));
  EXPECT_TRUE(by_row.channels.empty());
}

TEST(ReadMeasuredFormat, ReadsWhichRowsToSkip) {
  const MeasuredFormat format = read("skip_rows_where: {column: Type, is: Average of all}");
  EXPECT_EQ(format.skip.value().column, "Type");
  EXPECT_EQ(format.skip.value().is, "Average of all");
}

TEST(ReadMeasuredFormat, RefusesWhatItDoesNotKnow) {
  EXPECT_EQ(error_of("delimiter: '|'"),
            "batch.yaml:1:12: delimiter: expected one of tab, comma, semicolon, found '|'");
  EXPECT_EQ(error_of("decimal: dot"),
            "batch.yaml:1:10: decimal: expected one of comma, point, found 'dot'");
  EXPECT_EQ(error_of("skip_rows_where: {column: Type}"),
            "batch.yaml:1:18: skip_rows_where.is: expected the key 'is', found 'only column'");
  EXPECT_EQ(error_of("header: no"),
            "batch.yaml:1:1: header: expected one of the keys columns, decimal, delimiter, "
            "skip_rows_where, found 'header'");
}

TEST(ReadMeasuredFormat, RefusesColumnsThatDoNotGoTogether) {
  const std::string expected =
      "batch.yaml:1:10: columns: expected a column for each channel, or the columns channel and "
      "value, found ";
  EXPECT_EQ(error_of("columns: {panel: No}"), expected + "'neither'");
  EXPECT_EQ(error_of("columns: {channel: G, value: V, \"60\": Out}"), expected + "'both'");
  EXPECT_EQ(error_of("columns: {value: V, \"60\": Out}"),
            "batch.yaml:1:10: columns: expected both of the columns channel and value, found 'only "
            "value'");
  EXPECT_EQ(error_of("columns: {\"60\": Out, 60 deg: Out}"),
            "batch.yaml:1:30: columns.60 deg: expected each channel once, found '60 a second "
            "time'");
}

TEST(ReadMeasuredFormat, KnowsTheChannelsOfItsBatch) {
  EXPECT_EQ(test::batch_error(test::batch_text + "readings: {columns: {\"20\": A, \"60\": B}}\n"),
            "13:28: readings.columns.20: expected a column of a role (lot, panel, position, "
            "repetition, instrument, operator, channel, value), or of a channel (60), found '20'");
  EXPECT_EQ(test::batch_error(
                test::replaced(test::batch_text, "52 +- 6 GU", "52 +- 6 GU, \"85\": <= 80 GU") +
                "readings: {columns: {\"60\": B}}\n")
                .substr(0, 3),
            "11:");  // pocket_gloss_60 has no 85
  const std::string two =
      test::replaced(test::replaced(test::batch_text, "52 +- 6 GU", "52 +- 6 GU, \"85\": <= 80 GU"),
                     ", pocket_gloss_60", "");
  EXPECT_EQ(test::batch_error(two + "readings: {columns: {60 deg: B}}\n"),
            "13:21: readings.columns: expected a column for the channel 85, which the batch reads, "
            "found 'none'");
  EXPECT_EQ(test::batch_of(two + "readings: {columns: {60 deg: B, \"85\": C}}\n")
                .measured.value()
                .channels.size(),
            2u);
}

}  // namespace
}  // namespace gonio
