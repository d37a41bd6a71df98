#include "emulator/quality/measured_readings.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/unit/quality/batch_text.hpp"
#include "tests/unit/quality/made_batch.hpp"

namespace gonio {
namespace {

using test::TemporaryFolder;

/// A batch that reads some geometries, with a map `readings`.
Batch batch_for(const std::vector<std::string>& geometries, const std::string& readings = "") {
  Batch batch = test::made_batch(geometries);
  batch.instruments.push_back(batch.instruments.front());
  batch.instruments.back().id = "pocket";
  batch.operators = {{.id = "anna"}, {.id = "ben"}};
  if (!readings.empty()) {
    batch.measured = read_measured_format(YamlNode::parse(readings, "batch.yaml"));
  }
  return batch;
}

std::vector<PanelRecord> load(std::string_view text, const Batch& batch) {
  const TemporaryFolder folder;
  return load_measured_readings(folder.file("readings.csv", text), batch);
}

/// What loading says, from the line on.
std::string error_of(std::string_view text, const Batch& batch) {
  const std::string message = test::message_of([&] { (void)load(text, batch); });
  const std::size_t name = message.find("readings.csv:");
  return name == std::string::npos ? message : message.substr(name + 13);
}

/// Each panel as number/lot/label: and its readings as channel@position.repetition=value.
std::string words(const std::vector<PanelRecord>& panels) {
  std::string text;
  for (const PanelRecord& panel : panels) {
    text +=
        fmt::format("{}{}/{}/{}:", text.empty() ? "" : "; ", panel.number, panel.lot, panel.label);
    for (const ReadingRecord& reading : panel.readings) {
      text += fmt::format(" {}@{}.{}={}", reading.channel, reading.position, reading.repetition,
                          reading.value);
    }
  }
  return text;
}

const std::string two_rows = "1/1/: 0@1.1=30.24; 2/1/: 0@1.1=30.5";

TEST(MeasuredReadings, AreTheSameWhateverTheDelimiterAndTheDecimalSign) {
  const Batch point = batch_for({"60"});
  EXPECT_EQ(words(load("60\n30.24\n30.5\n", point)), two_rows);
  EXPECT_EQ(words(load("No,60\n1,30.24\n2,30.5\n", point)), two_rows);
  EXPECT_EQ(words(load("No\t60\n1\t30.24\n2\t30.5\n", point)), two_rows);
  EXPECT_EQ(words(load("No;60\n1;30.24\n2;30.5\n", point)), two_rows);
  const Batch comma = batch_for({"60"}, "decimal: comma");
  EXPECT_EQ(words(load("60\n30,24\n30,5\n", comma)), two_rows);
  EXPECT_EQ(words(load("No\t60\n1\t30,24\n2\t30,5\n", comma)), two_rows);
  EXPECT_EQ(words(load("No;60\n1;30,24\n2;30,5\n", comma)), two_rows);
  EXPECT_EQ(words(load("No,60\n1,\"30,24\"\n2,\"30,5\"\n", comma)), two_rows);
}

TEST(MeasuredReadings, AreTheSameWhateverTheLinesLookLike) {
  const Batch batch = batch_for({"60"});
  EXPECT_EQ(words(load("\xEF\xBB\xBFNo;60\r\n\r\n1;30.24\r\n\r\n2;30.5", batch)), two_rows);
  EXPECT_EQ(words(load("No;60;\n1;30.24;\n2;30.5;;;\n;;\n", batch)), two_rows);
  EXPECT_EQ(words(load("\n\nNote;60\n\"a;b \"\"c\"\"\";30.24\n\"two\nlines\"; +30.50 \n", batch)),
            two_rows);
  using namespace std::string_view_literals;
  EXPECT_EQ(words(load("\xFF\xFE"
                       "6\0"
                       "0\0\n\0"
                       "3\0"
                       "0\0.\0"
                       "2\0"
                       "4\0\n\0"
                       "3\0"
                       "0\0.\0"
                       "5\0"sv,
                       batch)),
            two_rows);
}

TEST(MeasuredReadings, NumberLotsAndPanelsAsTheyFirstCome) {
  EXPECT_EQ(
      words(load("lot,panel,60\nB,b1,1\nB,b2,2\nA,a1,3\nB,b1,4\nA,a1,5\n", batch_for({"60"}))),
      "1/1/b1: 0@1.1=1 0@2.1=4; 2/1/b2: 0@1.1=2; 3/2/a1: 0@1.1=3 0@2.1=5");
}

TEST(MeasuredReadings, KeepTheLotsTogether) {
  EXPECT_EQ(words(load("lot,panel,60\nB,1,1\nA,2,2\nB,3,3\n", batch_for({"60"}))),
            "1/1/1: 0@1.1=1; 2/1/3: 0@1.1=3; 3/2/2: 0@1.1=2");
}

TEST(MeasuredReadings, MayStandInOneColumnForEachChannel) {
  EXPECT_EQ(words(load("panel;Twenty;60 deg;more\n7;80.1;90.2;x\n7;80.3;90.4;y\n",
                       batch_for({"20", "60"},
                                 "columns: {panel: panel, \"20\": Twenty, "
                                 "\"60\": 60 deg}"))),
            "1/1/7: 0@1.1=80.1 1@1.1=90.2 0@2.1=80.3 1@2.1=90.4");
}

TEST(MeasuredReadings, MayStandInOneRowEach) {
  const std::string expected =
      "1/1/P: 0@1.1=80.1 1@1.1=90.2 0@2.1=80.3; 2/1/Q: 1@1.1=90.5 0@1.1=80.6";
  EXPECT_EQ(
      words(load("panel,channel,value\nP,20,80.1\nP,60,90.2\nP,20,80.3\nQ,60,90.5\nQ,20,80.6\n",
                 batch_for({"20", "60"}))),
      expected);
  EXPECT_EQ(words(load("P,G,V\nP,20,80.1\nP,60,90.2\nP,20,80.3\nQ,60,90.5\nQ,20,80.6\n",
                       batch_for({"20", "60"}, "columns: {panel: P, channel: G, value: V}"))),
            expected);
}

TEST(MeasuredReadings, TakeAColumnValueForAnotherOneWithoutAChannel) {
  EXPECT_EQ(words(load("value,60\nx,1\n", batch_for({"60"}))), "1/1/: 0@1.1=1");
}

TEST(MeasuredReadings, HaveThePositionsAndRepetitionsThatAreStated) {
  EXPECT_EQ(
      words(load("panel,position,repetition,60\nP,2,1,1\nP,2,2,2\nP,1,1,3\n", batch_for({"60"}))),
      "1/1/P: 0@2.1=1 0@2.2=2 0@1.1=3");
  EXPECT_EQ(words(load("panel,repetition,60\nP,1,1\nP,2,2\nP,1,3\nP,2,4\n", batch_for({"60"}))),
            "1/1/P: 0@1.1=1 0@1.2=2 0@2.1=3 0@2.2=4");
}

TEST(MeasuredReadings, KnowInstrumentsAndOperators) {
  const auto panels =
      load("panel,instrument,operator,60\nP,pocket,ben,1\nP,nominal,ben,2\nP,pocket,ben,3\n",
           batch_for({"60"}));
  EXPECT_EQ(words(panels), "1/1/P: 0@1.1=1 0@1.1=2 0@2.1=3");
  EXPECT_EQ(panels[0].readings[0].instrument, 1u);
  EXPECT_EQ(panels[0].readings[0].operator_, 1u);
  EXPECT_EQ(panels[0].readings[1].instrument, 0u);
}

TEST(MeasuredReadings, AreOfTheInspectionAndNotJudged) {
  const PanelRecord panel = load("60\n1\n", batch_for({"60"})).at(0);
  EXPECT_EQ(panel.study, PanelRecord::Study::inspection);
  EXPECT_TRUE(panel.channels.empty());
  EXPECT_EQ(panel.verdict, ConformanceVerdict::not_applicable);
}

TEST(MeasuredReadings, LeaveOutRowsThatAreNone) {
  const Batch batch = batch_for({"60"}, "skip_rows_where: {column: Type, is: mean}");
  EXPECT_EQ(words(load("Type,60\none,1\nmean,x\nMean,2\n", batch)), "1/1/: 0@1.1=1; 2/1/: 0@1.1=2");
}

TEST(MeasuredReadings, HaveNoReadingsOfHaze) {
  Batch batch = batch_for({"60"});
  batch.channels.push_back(
      {.id = "haze", .geometry = "", .kind = BatchChannel::Kind::haze, .unit = "GU"});
  EXPECT_EQ(words(load("60\n1\n", batch)), "1/1/: 0@1.1=1");
  EXPECT_EQ(error_of("channel,value\nhaze,1\n", batch),
            "2:1: channel: expected a channel with readings of its own; haze follows from those of "
            "gloss, found 'haze'");
}

TEST(MeasuredReadings, SayWhichColumnIsMissing) {
  EXPECT_EQ(error_of("No;Gloss\n1;2\n", batch_for({"60"})),
            "1:1: expected a column '60' for the channel 60, found 'only No, Gloss'");
  EXPECT_EQ(
      error_of("\nNo;Gloss;\n1;2\n", batch_for({"60"}, "columns: {panel: Panel, \"60\": Gloss}")),
      "2:1: expected a column 'Panel' for the panel, found 'only No, Gloss'");
  EXPECT_EQ(error_of("60\n1\n", batch_for({"60"}, "skip_rows_where: {column: Type, is: mean}")),
            "1:1: expected a column 'Type' that tells which rows to skip, found 'only 60'");
  EXPECT_EQ(error_of("channel,gloss\n60,1\n", batch_for({"60"})),
            "1:1: expected a column 'value' beside the column 'channel', found 'only channel, "
            "gloss'");
  EXPECT_EQ(error_of("60,a,60\n1,2,3\n", batch_for({"60"})),
            "1:6: expected one column '60', found 'a second one'");
}

TEST(MeasuredReadings, SayWhereANumberIsNone) {
  const Batch point = batch_for({"60"});
  for (const char* text : {"x", "1 234.5", "30.2.4", "30.24 GU", "nan", "--", "1'234"}) {
    EXPECT_EQ(error_of(fmt::format("No;60\n1;30\n2; {}\n", text), point),
              fmt::format("3:4: 60: expected a number with a decimal point and no thousands "
                          "separators, found '{}'",
                          text));
  }
  EXPECT_EQ(error_of("No;60\n1;1,234.5\n", point).substr(0, 7), "2:3: 60");
  EXPECT_EQ(error_of("No;60\n1;30,24\n", point).substr(0, 7), "2:3: 60");
  EXPECT_EQ(error_of("No;60\n1;\n", point),
            "2:3: 60: expected a number with a decimal point and no thousands separators, found "
            "nothing");
  const Batch comma = batch_for({"60"}, "decimal: comma");
  for (const char* text : {"30.24", "1.234,5", "1,234,5"}) {
    EXPECT_EQ(error_of(fmt::format("No;60\n1;{}\n", text), comma),
              fmt::format("2:3: 60: expected a number with a decimal comma and no thousands "
                          "separators, found '{}'",
                          text));
  }
}

TEST(MeasuredReadings, SayWhereARowHasTheWrongCells) {
  EXPECT_EQ(error_of("No,60,c\n1,2,3\n1,2\n", batch_for({"60"})),
            "3:3: expected 3 cells, found '2 cells'");
  EXPECT_EQ(error_of("No,60\n1,30,24\n", batch_for({"60"}, "decimal: comma")),
            "2:6: expected 2 cells, found '3 cells'");
}

TEST(MeasuredReadings, SayWhoIsNotOfTheBatch) {
  const Batch batch = batch_for({"60"});
  EXPECT_EQ(error_of("instrument,60\nround,1\n", batch),
            "2:1: instrument: expected one of the instruments nominal, pocket, found 'round'");
  EXPECT_EQ(error_of("operator,60\n,1\n", batch),
            "2:1: operator: expected one of the operators anna, ben, found nothing");
  EXPECT_EQ(error_of("channel,value\n85,1\n", batch),
            "2:1: channel: expected one of the channels 60, found '85'");
}

TEST(MeasuredReadings, SayWhatIsNoCount) {
  for (const char* text : {"0", "-1", "1.5", "x", "2000000"}) {
    EXPECT_EQ(
        error_of(fmt::format("panel,position,60\nP,{},1\n", text), batch_for({"60"})),
        fmt::format("2:3: position: expected a whole number in [1, 1000000], found '{}'", text));
  }
  EXPECT_EQ(error_of("panel,60\n,1\n", batch_for({"60"})),
            "2:1: panel: expected the name of a panel, found nothing");
}

TEST(MeasuredReadings, ComeOnce) {
  EXPECT_EQ(error_of("panel,position,60\nP,1,1\nP,2,2\nQ,1,3\nP,2,4\n", batch_for({"60"})),
            "5:5: expected each reading once (a column for the repetition tells them apart), found "
            "'panel P, channel 60, position 2, repetition 1 a second time, after line 3'");
  EXPECT_EQ(words(load("panel,position,operator,60\nP,1,anna,1\nP,1,ben,2\n", batch_for({"60"}))),
            "1/1/P: 0@1.1=1 0@1.1=2");
}

TEST(MeasuredReadings, NameAPanelWithoutAChannel) {
  EXPECT_EQ(error_of("panel,channel,value\nP,20,1\nP,60,1\n\nQ,20,1\n", batch_for({"20", "60"})),
            "5:1: expected readings of panel Q in the channel 60, found 'none'");
}

TEST(MeasuredReadings, NameAPanelInTwoLots) {
  EXPECT_EQ(error_of("lot,panel,60\nA,1,1\nB,1,1\n", batch_for({"60"})),
            "3:1: lot: expected the lot of the first row of panel 1 (panels of two lots need two "
            "names), found 'B'");
}

TEST(MeasuredReadings, AreAtLeastOne) {
  const auto error = [](std::string_view text, const Batch& batch) {
    const std::string message = test::message_of([&] { (void)load(text, batch); });
    return message.substr(message.find("readings.csv") + 12);
  };
  EXPECT_EQ(error("60\n", batch_for({"60"})), ": expected rows of readings, found 'none'");
  EXPECT_EQ(
      error("Type,60\nmean,1\n", batch_for({"60"}, "skip_rows_where: {column: Type, is: mean}")),
      ": expected rows that are readings, found 'none'");
  EXPECT_EQ(error(" \n", batch_for({"60"})),
            ": expected a file with content, found 'an empty file'");
}

TEST(MeasuredReadings, AreText) {
  EXPECT_EQ(error_of("60\n1\n\u0422\xD2\n", batch_for({"60"})),
            "3:2: expected text in UTF-8, or in UTF-16 with a byte order mark, found 'the byte "
            "0xD2'");
  EXPECT_NE(test::message_of([] { (void)load("\xFE\xFF", batch_for({"60"})); })
                .find("readings.csv: expected UTF-8, or UTF-16 with its low byte first, found "
                      "'UTF-16 with its high byte first'"),
            std::string::npos);
}

// The two single readings of the real export; the row of their average is left out.
TEST(MeasuredReadings, OfARealExportAreReadExactly) {
  const Catalog catalog = test::shipped();
  const Batch batch = load_batch(catalog.find(Catalog::Kind::batch, "bleskomer_export"), catalog);
  EXPECT_EQ(words(load_measured_readings(catalog.fixture("measured/bleskomer_export.txt"), batch)),
            "1/1/: 0@1.1=21.23; 2/1/: 0@1.1=20.9");
}

TEST(MeasuredReadings, OfTheInventedBatchAreThreeLotsOfFourPanels) {
  const Catalog catalog = test::shipped();
  const Batch batch =
      load_batch(catalog.find(Catalog::Kind::batch, "coil_coating_60_measured"), catalog);
  const auto panels =
      load_measured_readings(catalog.fixture("measured/coil_coating_60_invented.csv"), batch);
  ASSERT_EQ(panels.size(), 12u);
  EXPECT_EQ(words({panels[0]}), "1/1/C-101/1: 0@1.1=52 0@2.1=52 0@3.1=53");
  EXPECT_EQ(panels[1].readings[0].value, 51.8);
  EXPECT_EQ(panels[11].lot, 3u);
  for (const PanelRecord& panel : panels) {
    EXPECT_EQ(panel.readings.size(), 3u);
  }
}

}  // namespace
}  // namespace gonio
