#include "emulator/optics/refractive_index.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "emulator/core/table.hpp"
#include "emulator/optics/colorimetry.hpp"
#include "emulator/optics/fresnel.hpp"
#include "tests/unit/csv_rows.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

namespace fs = std::filesystem;
using Complex = std::complex<double>;
using test::message_of;
using test::TemporaryFolder;

const std::string fixtures = GONIO_SOURCE_DIR "/fixtures/";
const std::string nk = fixtures + "nk/";
constexpr Wavelength helium_d = nanometres(587.5618);

std::vector<fs::path> database_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(nk)) {
    if (entry.path().extension() == ".yml") {
      files.push_back(entry.path());
    }
  }
  return files;
}

/// The index in a file that holds these blocks.
RefractiveIndex loaded(const std::string& data) {
  const TemporaryFolder folder;
  return RefractiveIndex::load(folder.file("a.yml", data));
}

/// The message of load for a file of this text, from "a.yml" on.
std::string load_error(const std::string& text) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("a.yml", text);
  const std::string message = message_of([&] { (void)RefractiveIndex::load(path); });
  return message.substr(std::min(folder.path().string().size() + 1, message.size()));
}

// Constants.

TEST(RefractiveIndexConstant, IsTheSameEverywhere) {
  const RefractiveIndex index = RefractiveIndex::constant({0.6, 2.6});
  EXPECT_EQ(index.at(nanometres(1)), Complex(0.6, 2.6));
  EXPECT_EQ(index.at(nanometres(1e6)), Complex(0.6, 2.6));
  const Eigen::ArrayXcd samples = index.sample(WavelengthGrid::visible());
  ASSERT_EQ(samples.size(), 81);
  EXPECT_TRUE((samples == Complex(0.6, 2.6)).all());
}

TEST(RefractiveIndexConstant, RefusesValuesOutsideItsRange) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const Complex n_hat : {Complex(0, 0), Complex(-1.5, 0), Complex(1.5, -0.1),
                              Complex(std::nan(""), 0), Complex(1.5, infinity)}) {
    EXPECT_THROW((void)RefractiveIndex::constant(n_hat), std::domain_error) << n_hat;
  }
}

// The database.

TEST(RefractiveIndexLoad, ReadsEveryFileOfTheDatabase) {
  const std::vector<fs::path> files = database_files();
  EXPECT_EQ(files.size(), 163U);
  for (const fs::path& file : files) {
    const RefractiveIndex index = RefractiveIndex::load(file);
    EXPECT_LE(index.first(), index.last()) << file;
    const Complex n_hat = index.at(index.first());
    EXPECT_GT(n_hat.real(), 0.0) << file;
    EXPECT_GE(n_hat.imag(), 0.0) << file;
  }
}

TEST(RefractiveIndexLoad, GivesTheIndexThatCataloguesQuoteForTheDLine) {
  // Catalogues fit their formulas to measured indices: the worst of 1625 glasses differs by 3.8e-5.
  constexpr double fit = 4e-5;
  constexpr double three_decimals = 5e-4;  // for the one glass that is quoted so
  int glasses = 0;
  for (const fs::path& file : database_files()) {
    const YamlNode root = YamlNode::load(file);
    const auto properties = YamlMap(root).optional("PROPERTIES");
    const auto quoted = properties ? YamlMap(*properties).optional("nd") : std::nullopt;
    if (quoted) {
      const double n = RefractiveIndex::load(file).at(helium_d).real();
      EXPECT_NEAR(n, quoted->number(), quoted->text().size() > 5 ? fit : three_decimals) << file;
      ++glasses;
    }
  }
  EXPECT_EQ(glasses, 20);
}

struct QuotedIndex {
  const char* file;
  Wavelength lambda;
  Complex n_hat;
  double tolerance;
};

TEST(RefractiveIndexLoad, GivesPublishedValuesForEachKindOfBlock) {
  constexpr double decimals_5 = 4e-5;
  constexpr double exact = 1e-12;
  const std::vector<QuotedIndex> quoted = {
      // tabulated nk, rows of the table and the middle of two
      {"main/Cu/Johnson.yml", nanometres(548.6), {1.02, 2.577}, exact},
      {"main/Cu/Johnson.yml", nanometres(0.5 * (548.6 + 582.1)), {0.86, 2.6405}, exact},
      // formula 1: sapphire, ordinary ray
      {"main/Al2O3/Malitson.yml", helium_d, 1.76823, decimals_5},
      // formula 1: fused silica
      {"main/SiO2/Malitson.yml", helium_d, 1.45846, decimals_5},
      // formula 2
      {"specs/schott/optical/N-BK7.yml", helium_d, 1.5168, decimals_5},
      {"specs/schott/optical/F2.yml", helium_d, 1.62004, decimals_5},
      {"specs/ohara/optical/S-TIL26.yml", helium_d, 1.567322, decimals_5},
      // formula 3
      {"specs/hikari/optical/J-LF6.yml", helium_d, 1.56732, decimals_5},
  };
  for (const QuotedIndex& row : quoted) {
    const Complex got = RefractiveIndex::load(nk + row.file).at(row.lambda);
    EXPECT_NEAR(got.real(), row.n_hat.real(), row.tolerance) << row.file;
    if (row.n_hat.imag() > 0.0) {
      EXPECT_NEAR(got.imag(), row.n_hat.imag(), row.tolerance) << row.file;
    }
  }
}

TEST(RefractiveIndexLoad, GivesTheReflectanceThatAnIndependentProgramGives) {
  constexpr double printed_rho = 0.6e-5;  // five decimals
  constexpr double printed_n = 1e-5;      // six digits, and the d line rounded
  constexpr double printed_xyz = 0.6e-4;  // four decimals
  constexpr double printed_lab = 0.6e-3;  // three decimals
  const WavelengthGrid grid = WavelengthGrid::visible();
  const Eigen::ArrayXd c = SpectralTable::load(fixtures + "illuminants/c.csv").sample(grid);
  const Eigen::ArrayXd d65 = SpectralTable::load(fixtures + "illuminants/d65.csv").sample(grid);
  const Eigen::ArrayXd v = SpectralTable::load(fixtures + "observers/v_lambda.csv").sample(grid);
  const Observer observer = Observer::load(fixtures + "observers/cie_1931_2deg.csv", grid);
  const auto luminous_reflectance = [weight = Eigen::ArrayXd(c * v / (c * v).sum())](
                                        double theta_deg, const Eigen::ArrayXcd& n_hat) {
    return (weight * fresnel_reflectance(std::cos(degrees(theta_deg).radians()), n_hat)).sum();
  };
  int materials = 0;
  for (const auto& row : test::csv_rows(fixtures + "reference/fresnel_gloss_materials.csv")) {
    if (row.text("ext_pts") != "0") {
      continue;  // that program extrapolates by up to 30 nm, this one refuses to
    }
    const std::string file = row.text("file");
    const RefractiveIndex index = RefractiveIndex::load(nk + file);
    const Eigen::ArrayXcd n_hat = index.sample(grid);
    EXPECT_NEAR(index.at(helium_d).real(), row.number("n_d"), printed_n * row.number("n_d"))
        << file;
    EXPECT_NEAR(luminous_reflectance(20, n_hat), row.number("rho20_C"), printed_rho) << file;
    EXPECT_NEAR(luminous_reflectance(60, n_hat), row.number("rho60_C"), printed_rho) << file;
    EXPECT_NEAR(luminous_reflectance(85, n_hat), row.number("rho85_C"), printed_rho) << file;
    const Xyz colour = tristimulus(fresnel_reflectance(1.0, n_hat), d65, observer);
    EXPECT_NEAR(colour.X, row.number("X0"), printed_xyz) << file;
    EXPECT_NEAR(colour.Y, row.number("Y0"), printed_xyz) << file;
    EXPECT_NEAR(colour.Z, row.number("Z0"), printed_xyz) << file;
    const Lab lab = cielab(colour, white_point(d65, observer));
    EXPECT_NEAR(lab.L, row.number("L0"), printed_lab) << file;
    EXPECT_NEAR(lab.a, row.number("a0"), printed_lab) << file;
    EXPECT_NEAR(lab.b, row.number("b0"), printed_lab) << file;
    ++materials;
  }
  EXPECT_EQ(materials, 114);
}

// What a file covers.

TEST(RefractiveIndexSample, HasNoValuesWhereTheFileHasNone) {
  const RefractiveIndex ordal = RefractiveIndex::load(nk + "main/Cu/Ordal.yml");
  EXPECT_EQ(message_of([&] { (void)ordal.sample(WavelengthGrid::visible()); }),
            nk + "main/Cu/Ordal.yml: expected values from 380 nm to 780 nm, "
                 "found 'values from 517 nm to 55600 nm'");
  EXPECT_NO_THROW((void)ordal.at(nanometres(517)));
  EXPECT_THROW((void)ordal.at(nanometres(516.99)), InputError);
}

TEST(RefractiveIndexSample, BlamesThePlaceThatNamesTheFile) {
  const YamlNode root = YamlNode::parse(
      "surface:\n  model: smooth\n  refractive_index: {file: nk/main/Cu/Ordal.yml}\n",
      fixtures + "x.yaml");
  const YamlNode surface = YamlMap(root).required("surface");
  const RefractiveIndex ordal =
      RefractiveIndex::read(YamlMap(surface).required("refractive_index"));
  EXPECT_EQ(message_of([&] { (void)ordal.sample(WavelengthGrid::visible()); }),
            fixtures +
                "x.yaml:3:28: surface.refractive_index.file: expected values from 380 nm to "
                "780 nm, found 'values from 517 nm to 55600 nm'");
}

TEST(RefractiveIndexSample, RefusesANegativeK) {
  const RefractiveIndex hematite = RefractiveIndex::load(nk + "main/Fe2O3/Querry-o.yml");
  EXPECT_GT(hematite.at(nanometres(550)).imag(), 0.0);
  EXPECT_EQ(message_of([&] { (void)hematite.at(micrometres(50)); }),
            nk + "main/Fe2O3/Querry-o.yml: expected n in (0, 1000] and k in [0, 1000], "
                 "found 'n = 6.094, k = -0.117 at 50000 nm'");
}

TEST(RefractiveIndexSample, RefusesAnIndexThatIsNotPositive) {
  const auto at_half_um = [](const std::string& block) {
    const RefractiveIndex index = loaded("DATA:\n  - type: " + block);
    return message_of([&] { (void)index.at(nanometres(500)); });
  };
  EXPECT_THAT(at_half_um("formula 3\n    wavelength_range: 0.4 0.7\n    coefficients: -2\n"),
              testing::HasSubstr("expected n in (0, 1000] and k in [0, 1000], found 'n = "));
  EXPECT_THAT(at_half_um("formula 2\n    wavelength_range: 0.4 0.7\n    coefficients: 0 1 0.25\n"),
              testing::HasSubstr(
                  "expected n in (0, 1000] and k in [0, 1000], found 'n = inf, k = 0 at 500 nm'"));
  EXPECT_THAT(at_half_um("tabulated n\n    data: |\n        0.4 0\n        0.7 0\n"),
              testing::HasSubstr(
                  "expected n in (0, 1000] and k in [0, 1000], found 'n = 0, k = 0 at 500 nm'"));
}

TEST(RefractiveIndexSample, EqualsTheValuesOneByOne) {
  const RefractiveIndex index = RefractiveIndex::load(nk + "specs/schott/optical/N-BK7.yml");
  const WavelengthGrid grid = WavelengthGrid::visible();
  const Eigen::ArrayXcd samples = index.sample(grid);
  for (Eigen::Index i = 0; i < grid.size(); ++i) {
    EXPECT_EQ(samples(i), index.at(nanometres(grid.nanometres()(i))));
  }
}

// Tables.

TEST(RefractiveIndexTable, IsLinearBetweenItsRows) {
  const RefractiveIndex index = loaded(
      "DATA:\n  - type: tabulated nk\n    data: |\n"
      "        0.40 1.6 0.2\n        0.50 1.5 0.4\n        0.80 1.2 1.0\n");
  EXPECT_EQ(index.first(), nanometres(400));
  EXPECT_EQ(index.last(), nanometres(800));
  EXPECT_EQ(index.at(nanometres(500)), Complex(1.5, 0.4));
  EXPECT_DOUBLE_EQ(index.at(nanometres(450)).real(), 1.55);
  EXPECT_DOUBLE_EQ(index.at(nanometres(700)).imag(), 0.8);
}

TEST(RefractiveIndexTable, MayDescendAndUseTabs) {
  const RefractiveIndex index = loaded(
      "DATA:\n  - type: tabulated nk\n    data: |\n"
      "        0.80\t1.2\t1.0\n        0.50  1.5   0.4\n\n        0.40 1.6 0.2 \n");
  EXPECT_EQ(index.first(), nanometres(400));
  EXPECT_EQ(index.last(), nanometres(800));
  EXPECT_DOUBLE_EQ(index.at(nanometres(450)).real(), 1.55);
  EXPECT_DOUBLE_EQ(index.at(nanometres(700)).imag(), 0.8);
}

TEST(RefractiveIndexTable, AveragesRowsAtTheSameWavelength) {
  const RefractiveIndex index = loaded(
      "DATA:\n  - type: tabulated nk\n    data: |\n"
      "        0.40 1.6 0.2\n        0.50 1.5 0.4\n        0.50 1.3 0.5\n        0.80 1 1\n");
  EXPECT_DOUBLE_EQ(index.at(nanometres(500)).real(), 1.4);
  EXPECT_DOUBLE_EQ(index.at(nanometres(500)).imag(), 0.45);
  EXPECT_DOUBLE_EQ(index.at(nanometres(450)).real(), 1.5);
}

TEST(RefractiveIndexTable, PlacesABadRow) {
  const std::string head = "# a comment\nDATA:\n  - type: tabulated nk\n    data: |\n";
  EXPECT_EQ(load_error(head + "        0.4 1.6 0.2\n        0.5 1.6 O.2\n"),
            "a.yml:6:1: DATA[0].data: expected numbers, found 'O.2'");
  EXPECT_EQ(load_error(head + "        0.4 1.6 0.2\n        0.5 1.6\n"),
            "a.yml:6:1: DATA[0].data: expected 3 numbers, found '0.5 1.6'");
  EXPECT_EQ(load_error(head + "        0.4 1.6 0.2\n\n        0.5 nan 0\n"),
            "a.yml:7:1: DATA[0].data: expected numbers, found 'nan'");
  EXPECT_EQ(load_error(head + "        -0.4 1.6 0.2\n"),
            "a.yml:5:1: DATA[0].data: expected a wavelength > 0, found '-0.4 1.6 0.2'");
  EXPECT_EQ(load_error("DATA:\n  - type: tabulated n\n    data: 0.4 1.6 0.2\n"),
            "a.yml:3:11: DATA[0].data: expected 2 numbers, found '0.4 1.6 0.2'");
}

// Several blocks.

const std::string cauchy =
    "  - type: formula 5\n    wavelength_range: 0.4 0.7\n    coefficients: 1.5\n";
const std::string table_k = "  - type: tabulated k\n    data: |\n      0.5 0.1\n      0.9 0.5\n";

TEST(RefractiveIndexBlocks, GiveNAndKInEitherOrderWhereBothCover) {
  for (const std::string& blocks : {cauchy + table_k, table_k + cauchy}) {
    const RefractiveIndex index = loaded("DATA:\n" + blocks);
    EXPECT_EQ(index.first(), nanometres(500));
    EXPECT_EQ(index.last(), nanometres(700));
    EXPECT_DOUBLE_EQ(index.at(nanometres(600)).real(), 1.5);
    EXPECT_DOUBLE_EQ(index.at(nanometres(600)).imag(), 0.2);
    EXPECT_THROW((void)index.at(nanometres(450)), InputError);
    EXPECT_THROW((void)index.at(nanometres(750)), InputError);
  }
}

TEST(RefractiveIndexBlocks, GiveNoAbsorptionWhereNoneIsTabulated) {
  EXPECT_EQ(loaded("DATA:\n" + cauchy).at(nanometres(400)), Complex(1.5, 0.0));
}

TEST(RefractiveIndexBlocks, MustGiveNOnceAndKAtMostOnce) {
  EXPECT_EQ(load_error("DATA:\n" + table_k),
            "a.yml:2:3: DATA: expected a block that gives n, found 'none'");
  EXPECT_EQ(load_error("DATA:\n" + cauchy + cauchy),
            "a.yml:5:5: DATA[1]: expected one block that gives n, found 'a second one'");
  EXPECT_EQ(load_error("DATA:\n" + cauchy + table_k + table_k),
            "a.yml:9:5: DATA[2]: expected one block that gives k, found 'a second one'");
}

TEST(RefractiveIndexBlocks, MustBeThere) {
  EXPECT_EQ(load_error("REFERENCES: none\n"),
            "a.yml:1:1: DATA: expected the key 'DATA', found 'only REFERENCES'");
  EXPECT_EQ(load_error("DATA: []\n"),
            "a.yml:1:7: DATA: expected a list of at least one item, found 'a list'");
}

TEST(RefractiveIndexBlocks, MustBeOfAKnownType) {
  for (const char* type : {"formula 10", "formula A", "formula", "tabulated n2", "Tabulated n"}) {
    EXPECT_EQ(load_error(fmt::format("DATA:\n  - type: {}\n", type)),
              fmt::format(
                  "a.yml:2:11: DATA[0].type: expected one of tabulated nk, tabulated n, tabulated "
                  "k, formula 1, formula 2, formula 3, formula 4, formula 5, formula 6, formula 7, "
                  "formula 8, formula 9, found '{}'",
                  type));
  }
}

// Formulas.

TEST(RefractiveIndexFormula, HasARangeUnderEitherName) {
  const RefractiveIndex index =
      loaded("DATA:\n  - type: formula 5\n    range: 0.4 0.7\n    coefficients: 1.5\n");
  EXPECT_EQ(index.first(), nanometres(400));
  EXPECT_EQ(index.last(), nanometres(700));
}

TEST(RefractiveIndexFormula, PlacesWhatIsMissingOrWrong) {
  const std::string head = "DATA:\n  - type: formula 8\n";
  const std::string range = "    wavelength_range: 0.4 0.7\n";
  EXPECT_EQ(load_error(head + range),
            "a.yml:2:5: DATA[0].coefficients: expected the key 'coefficients', "
            "found 'only type, wavelength_range'");
  EXPECT_EQ(load_error(head + "    coefficients: 1\n"),
            "a.yml:2:5: DATA[0].wavelength_range: expected the key 'wavelength_range', "
            "found 'only type, coefficients'");
  EXPECT_EQ(load_error(head + range + "    coefficients: 1 2 3 4 5\n"),
            "a.yml:4:19: DATA[0].coefficients: expected 1 to 4 coefficients, found '1 2 3 4 5'");
  EXPECT_EQ(load_error(head + range + "    coefficients: 1 x\n"),
            "a.yml:4:19: DATA[0].coefficients: expected numbers, found 'x'");
  for (const char* wrong : {"0.7 0.4", "0.4", "0 0.7", "0.4 0.5 0.6"}) {
    EXPECT_EQ(
        load_error(fmt::format("{}    wavelength_range: {}\n    coefficients: 1\n", head, wrong)),
        fmt::format("a.yml:3:23: DATA[0].wavelength_range: expected two wavelengths, "
                    "0 < first < last, found '{}'",
                    wrong));
  }
}

// Values in a YAML file of gonio.

RefractiveIndex read(const std::string& text) {
  return RefractiveIndex::read(
      YamlMap(YamlNode::parse("x: " + text + "\n", "a.yaml")).required("x"));
}
std::string read_error(const std::string& text) {
  return message_of([&] { (void)read(text); });
}

TEST(RefractiveIndexRead, TakesANumberOrNAndK) {
  EXPECT_EQ(read("1.567").at(nanometres(550)), Complex(1.567, 0.0));
  EXPECT_EQ(read("{n: 0.6, k: 2.6}").at(nanometres(550)), Complex(0.6, 2.6));
}

TEST(RefractiveIndexRead, RefusesAnythingElse) {
  EXPECT_EQ(read_error("0"), "a.yaml:1:4: x: expected a number in (0, 1000], found '0'");
  EXPECT_EQ(read_error("glass"), "a.yaml:1:4: x: expected a number in (0, 1000], found 'glass'");
  EXPECT_EQ(read_error("[1.5, 0]"),
            "a.yaml:1:4: x: expected a number, {n: ..., k: ...} or {file: ...}, found 'a list'");
  EXPECT_EQ(read_error("{n: 1.5, k: -1}"),
            "a.yaml:1:16: x.k: expected a number in [0, 1000], found '-1'");
  EXPECT_EQ(read_error("1e160"), "a.yaml:1:4: x: expected a number in (0, 1000], found '1e160'");
  EXPECT_EQ(read_error("{n: 1.5, k: 1e300}"),
            "a.yaml:1:16: x.k: expected a number in [0, 1000], found '1e300'");
  EXPECT_EQ(read_error("{n: 1.5}"), "a.yaml:1:4: x.k: expected the key 'k', found 'only n'");
  EXPECT_EQ(read_error("{n: 1.5, k: 0, kappa: 1}"),
            "a.yaml:1:19: x.kappa: expected one of the keys file, k, n, found 'kappa'");
  EXPECT_EQ(read_error("{file: no/such.yml}"),
            "a.yaml:1:11: x.file: expected a file, found 'no/such.yml'");
  EXPECT_EQ(read_error("{file: " + nk + "main/Cu/Johnson.yml, n: 1}"),
            "a.yaml:1:" + std::to_string(32 + nk.size()) +
                ": x.n: expected one of the keys file, found 'n'");
}

}  // namespace
}  // namespace gonio
