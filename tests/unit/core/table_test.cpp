#include "emulator/core/table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "tests/unit/message_of.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

using test::message_of;
using test::TemporaryFolder;

/// The message of CsvTable::load for a file of this text, from "a.csv" on.
std::string csv_error(std::string_view text) {
  const TemporaryFolder folder;
  const auto path = folder.file("a.csv", text);
  const std::string message = message_of([&] { (void)CsvTable::load(path); });
  return message.substr(std::min(folder.path().string().size() + 1, message.size()));
}

Eigen::ArrayXd array(std::initializer_list<double> values) {
  return Eigen::Map<const Eigen::ArrayXd>(values.begin(), Eigen::Index(values.size()));
}

const SourceMark table_mark{.file = "a.yaml", .line = 3, .column = 7, .key = "reflectance"};

TEST(CsvTable, ReadsColumnsByTheNamesInItsHeader) {
  const TemporaryFolder folder;
  const CsvTable table = CsvTable::load(folder.file("a.csv",
                                                    "wavelength_nm,n,k\n380,1.5,0\n"
                                                    "780,1.4,1e-6\n"));
  EXPECT_EQ(table.columns, (std::vector<std::string>{"wavelength_nm", "n", "k"}));
  ASSERT_EQ(table.values.rows(), 2);
  ASSERT_EQ(table.values.cols(), 3);
  EXPECT_EQ(table.column("n")(1), 1.4);
  EXPECT_EQ(table.column("k")(1), 1e-6);
}

TEST(CsvTable, NumbersTheColumnsOfAFileWithoutHeader) {
  const TemporaryFolder folder;
  const CsvTable table = CsvTable::load(folder.file("a.csv", "380,1.5\n780,1.4"));
  EXPECT_EQ(table.columns, (std::vector<std::string>{"1", "2"}));
  ASSERT_EQ(table.values.rows(), 2);
  EXPECT_EQ(table.column("2")(0), 1.5);
}

TEST(CsvTable, PassesOverCommentsEmptyLinesBlanksAndCarriageReturns) {
  const TemporaryFolder folder;
  const CsvTable table = CsvTable::load(folder.file(
      "a.csv",
      "\xEF\xBB\xBF# origin: a, b\r\n\r\n nm , R \r\n380 ,\t0.5\r\n  # note\r\n780,0.6\r\n"));
  EXPECT_EQ(table.columns, (std::vector<std::string>{"nm", "R"}));
  ASSERT_EQ(table.values.rows(), 2);
  EXPECT_EQ(table.values(0, 1), 0.5);
  EXPECT_EQ(table.values(1, 1), 0.6);
}

TEST(CsvTable, ReadsAnEmptyCellAsNaN) {
  const TemporaryFolder folder;
  const CsvTable table = CsvTable::load(folder.file("a.csv", "nm,a,b\n380,,2\n385,3,\n"));
  EXPECT_TRUE(std::isnan(table.values(0, 1)));
  EXPECT_EQ(table.values(0, 2), 2.0);
  EXPECT_TRUE(std::isnan(table.values(1, 2)));
}

TEST(CsvTable, PlacesACellThatIsNotANumber) {
  EXPECT_EQ(csv_error("nm,a\n380,1\n385, x1\n"), "a.csv:3:6: expected a number, found 'x1'");
  EXPECT_EQ(csv_error("380,1\nNaN,1\n"), "a.csv:2:1: expected a number, found 'NaN'");
  EXPECT_EQ(csv_error("380,1\n385,inf\n"), "a.csv:2:5: expected a number, found 'inf'");
}

TEST(CsvTable, DoesNotTakeAMistypedNumberForAHeader) {
  EXPECT_EQ(csv_error("38O,1\n385,1\n"),
            "a.csv:1:1: expected a number or the name of a column, found '38O'");
  EXPECT_EQ(csv_error("-1 nm,1\n385,1\n"),
            "a.csv:1:1: expected a number or the name of a column, found '-1 nm'");
}

TEST(CsvTable, PlacesARowOfAnotherLength) {
  EXPECT_EQ(csv_error("nm,a\n380,1\n385\n"), "a.csv:3:1: expected 2 cells, found '1 cells'");
  EXPECT_EQ(csv_error("nm,a\n380,1,\n"), "a.csv:2:1: expected 2 cells, found '3 cells'");
}

TEST(CsvTable, RefusesAFileWithoutRows) {
  EXPECT_EQ(csv_error("# only this\n"), "a.csv: expected rows of numbers, found 'none'");
  EXPECT_EQ(csv_error("nm,a\n"), "a.csv: expected rows of numbers, found 'none'");
}

TEST(CsvTable, NamesItsColumnsWhenOneIsNotThere) {
  const TemporaryFolder folder;
  const CsvTable table = CsvTable::load(folder.file("a.csv", "nm,a\n380,1\n"));
  EXPECT_EQ(message_of([&] { (void)table.column("b"); }),
            table.file + ": expected one of the columns nm, a, found 'b'");
}

TEST(SpectralTable, IsLinearBetweenItsPointsAndExactAtThem) {
  const SpectralTable table(array({400, 500, 700}), array({0.1, 0.3, 0.9}), table_mark);
  EXPECT_EQ(table.at(nanometres(400)), 0.1);
  EXPECT_EQ(table.at(nanometres(500)), 0.3);
  EXPECT_EQ(table.at(nanometres(700)), 0.9);
  EXPECT_DOUBLE_EQ(table.at(nanometres(425)), 0.15);
  EXPECT_DOUBLE_EQ(table.at(nanometres(600)), 0.6);
}

TEST(SpectralTable, ReproducesAStraightLineOnAnyGrid) {
  constexpr double rounding = 1e-14;  // a few units in the last place of values about 1
  const auto line = [](double nm) { return 2.0 - 0.002 * nm; };
  const SpectralTable table(array({380, 417, 555, 780}),
                            array({line(380), line(417), line(555), line(780)}), table_mark);
  const WavelengthGrid grid(nanometres(380), nanometres(1), 401);
  const Eigen::ArrayXd values = table.sample(grid);
  ASSERT_EQ(values.size(), grid.size());
  for (Eigen::Index i = 0; i < grid.size(); ++i) {
    EXPECT_NEAR(values(i), line(grid.nanometres()(i)), rounding) << grid.nanometres()(i) << " nm";
  }
}

TEST(SpectralTable, SortsItsPoints) {
  const SpectralTable table(array({700, 400, 500}), array({0.9, 0.1, 0.3}), table_mark);
  EXPECT_EQ(table.first(), nanometres(400));
  EXPECT_EQ(table.last(), nanometres(700));
  EXPECT_TRUE((table.wavelength_nm() == array({400, 500, 700})).all());
  EXPECT_TRUE((table.value() == array({0.1, 0.3, 0.9})).all());
}

TEST(SpectralTable, HasNoValuesOutsideItsPoints) {
  const SpectralTable table(array({400, 700}), array({0.1, 0.9}), table_mark);
  EXPECT_EQ(message_of([&] { (void)table.sample(WavelengthGrid::visible()); }),
            "a.yaml:3:7: reflectance: expected values from 380 nm to 780 nm, "
            "found 'values from 400 nm to 700 nm'");
  EXPECT_THROW((void)table.at(nanometres(399.99)), InputError);
  EXPECT_THROW((void)table.at(nanometres(700.01)), InputError);
}

TEST(SpectralTable, ForgivesTheRoundingOfAGridAtItsEnds) {
  const SpectralTable table(array({0.38 * 1000, 780}), array({0.1, 0.9}), table_mark);
  EXPECT_EQ(table.at(nanometres(std::nextafter(380.0, 0.0))), 0.1);
  EXPECT_EQ(table.at(nanometres(std::nextafter(780.0, 1000.0))), 0.9);
}

TEST(SpectralTable, RefusesADoubledWavelengthNoPointsAndNaN) {
  EXPECT_EQ(message_of([] {
              (void)SpectralTable(array({400, 500, 400}), array({1, 2, 3}), table_mark);
            }),
            "a.yaml:3:7: reflectance: expected each wavelength once, "
            "found '400 nm a second time'");
  EXPECT_THROW(SpectralTable(array({}), array({}), table_mark), InputError);
  EXPECT_THROW(SpectralTable(array({400, 500}), array({1}), table_mark), InputError);
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(SpectralTable(array({400, 500}), array({1, not_a_number}), table_mark), InputError);
  EXPECT_THROW(SpectralTable(array({400, not_a_number}), array({1, 2}), table_mark), InputError);
}

TEST(SpectralTable, LeavesOutTheRowsWhereItsColumnIsEmpty) {
  const TemporaryFolder folder;
  const auto path = folder.file("a.csv", "nm,A,B\n300,1,\n380,2,20\n780,4,40\n");
  const SpectralTable table = SpectralTable::load(path, "B");
  EXPECT_EQ(table.first(), nanometres(380));
  EXPECT_DOUBLE_EQ(table.at(nanometres(580)), 30.0);
  EXPECT_EQ(SpectralTable::load(path, "A").first(), nanometres(300));
}

TEST(SpectralTable, AsksForTheColumnWhereThereAreSeveral) {
  const TemporaryFolder folder;
  const auto path = folder.file("a.csv", "nm,A,B\n380,2,20\n");
  EXPECT_EQ(message_of([&] { (void)SpectralTable::load(path); }),
            path.string() +
                ": expected a column of wavelengths and one of values, or the name of a column, "
                "found '3 columns'");
}

TEST(SpectralTable, FromYamlBlamesThePlaceThatNamesTheFile) {
  const TemporaryFolder folder;
  (void)folder.file("a.csv", "nm,A,B\n400,2,20\n700,3,30\n");
  const auto path = folder.file("s.yaml", "reflectance:\n  file: a.csv\n  column: B\n");
  const YamlNode root = YamlNode::load(path);
  const SpectralTable table =
      root.read_map([](YamlMap& map) { return SpectralTable::load(map.required("reflectance")); });
  EXPECT_EQ(table.at(nanometres(400)), 20.0);
  EXPECT_EQ(message_of([&] { (void)table.at(nanometres(380)); }),
            path.string() +
                ":2:9: reflectance.file: expected values from 380 nm to 380 nm, "
                "found 'values from 400 nm to 700 nm'");
}

}  // namespace
}  // namespace gonio
