#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/unit/csv_rows.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/procedure/laboratory.hpp"
#include "tests/unit/temporary_folder.hpp"

// Figures of other programs, met from end to end: a sample file, a standard or an instrument, and
// the gloss at 20, 60 and 85 deg [GU].

namespace gonio {
namespace {

using test::is_close;
using test::meter_by_standard;
using test::shipped;
using test::shipped_meter;
using test::shipped_sample;
using test::TemporaryFolder;

constexpr double four_decimals = 1e-3;  // asked of the check values

struct Expected {
  double at_20, at_60, at_85;
};

void expect_gloss(const Sample& sample, const Glossmeter& meter, const Expected& expected,
                  double tolerance = four_decimals) {
  const Measurement measurement =
      measure(sample, meter, test::observer(), {.tolerance = 0.01 * tolerance});
  EXPECT_TRUE(is_close(measurement.find("20")->reading.gloss, expected.at_20, tolerance))
      << sample.id << " at 20";
  EXPECT_TRUE(is_close(measurement.find("60")->reading.gloss, expected.at_60, tolerance))
      << sample.id << " at 60";
  EXPECT_TRUE(is_close(measurement.find("85")->reading.gloss, expected.at_85, tolerance))
      << sample.id << " at 85";
}

void expect_gloss(const std::string& surface, const Glossmeter& meter, const Expected& expected) {
  const TemporaryFolder folder;
  expect_gloss(test::sample_of(folder.path() / "mine.yaml", surface), meter, expected);
}

TEST(SmoothGloss, OfTheReferenceGlassIs100) {
  constexpr double rounding = 1e-9;
  const Sample glass = shipped_sample("black_glass_n1567");
  for (const char* id : {"iso_2813/2014", "astm_d523/14"}) {
    expect_gloss(glass, meter_by_standard(id), {100, 100, 100}, rounding);
  }
  for (const char* id : {"nominal_iso_2813", "collimated_iso_2813"}) {
    expect_gloss(glass, shipped_meter(id), {100, 100, 100}, rounding);
  }
}

TEST(SmoothGloss, WithACollimatedSourceIsTheClosedForm) {
  const Glossmeter meter = shipped_meter("collimated_iso_2813");
  expect_gloss("{model: smooth, refractive_index: 1.5}", meter, {82.0452, 89.1368, 98.9746});
  expect_gloss(shipped_sample("perfect_mirror"), meter, {2037.5686, 999.4400, 161.5122});
}

TEST(SmoothGloss, WithTheStandardsSourceIsItsMeanOverTheImage) {
  const Glossmeter meter = meter_by_standard("iso_2813/2014");
  expect_gloss("{model: smooth, refractive_index: 1.5}", meter, {82.0454, 89.1385, 98.9730});
  expect_gloss(shipped_sample("perfect_mirror"), meter, {2037.5283, 999.2706, 161.6079});
}

TEST(LambertianGloss, IsThatOfAWhiteDiffuser) {
  expect_gloss(shipped_sample("white_diffuser"), meter_by_standard("iso_2813/2014"),
               {1.2025, 2.4841, 0.0327});
}

TEST(CookTorranceGloss, AgreesWithThreeOtherPrograms) {
  const Glossmeter meter = meter_by_standard("iso_2813/2014");
  const auto surface = [](const char* rms_slope) {
    return std::string("{model: cook_torrance, refractive_index: 1.567, rms_slope: ") + rms_slope +
           "}";
  };
  expect_gloss(surface("0.02"), meter, {29.8009, 82.1895, 77.6373});
  expect_gloss(surface("0.05"), meter, {6.2803, 41.0188, 37.7258});
  expect_gloss(surface("0.10"), meter, {1.6453, 18.1261, 19.5431});
}

TEST(CookTorranceGloss, AsPrintedIsFourTimesThat) {
  expect_gloss(
      "{model: cook_torrance, refractive_index: 1.567, rms_slope: 0.05, "
      "normalization: as_printed}",
      meter_by_standard("iso_2813/2014"), {4 * 6.2803, 4 * 41.0188, 4 * 37.7258});
}

// Smooth copper by the refractive indices of six authors: about 7 % apart.
TEST(SmoothGloss, OfCopperIsThatOfItsAuthor) {
  constexpr double whole_units = 1.0;
  const Glossmeter meter = meter_by_standard("iso_2813/2014");
  const auto expect = [&](const char* author, const Expected& expected) {
    expect_gloss(shipped_sample(std::string("copper_smooth_") + author), meter, expected,
                 whole_units);
  };
  expect("johnson", {1391, 681, 138});
  expect("hagemann", {1427, 699, 140});
  expect("querry", {1381, 685, 141});
  expect("babar", {1513, 745, 144});
  expect("mcpeak", {1542, 756, 144});
  expect("rakic_bb", {1498, 734, 143});
}

// n = 1.5673 at the d line: because of its dispersion it reads a little more than 100.
TEST(SmoothGloss, OfADispersiveGlassIsNotQuite100) {
  constexpr double printed = 0.06;  // one decimal
  const Measurement measurement =
      measure(shipped_sample("s_til26"), meter_by_standard("iso_2813/2014"), test::observer(), {});
  EXPECT_TRUE(is_close(measurement.find("20")->reading.gloss, 100.8, printed));
  EXPECT_TRUE(is_close(measurement.find("60")->reading.gloss, 100.5, printed));
  EXPECT_TRUE(is_close(measurement.find("85")->reading.gloss, 100.04, 0.006));
}

// Plane surfaces of measured materials on the axis, under four illuminants; two decimals.

Glossmeter collimated_under(const std::string& illuminant, const TemporaryFolder& folder) {
  const std::string closed = "{source: {in_plane: 0 deg, perpendicular: 0 deg}}";
  const auto file = folder.file(
      "collimated_" + illuminant + ".yaml",
      "schema: gonio/instrument/1\nid: collimated\ntitle: Collimated\nbuilt_to: iso_2813/2014\n"
      "as_built: {\"20\": " +
          closed + ", \"60\": " + closed + ", \"85\": " + closed + "}\n" +
          "source_spectrum: {file: '" +
          shipped().fixture("illuminants/" + illuminant + ".csv").string() + "'}\n");
  return test::meter_of(load_instrument(file, test::shipped()));
}

class MaterialGloss : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(MaterialGloss, AgreesWithTheReferenceFile) {
  const auto [illuminant, column] = GetParam();
  const TemporaryFolder folder;
  const Glossmeter meter = collimated_under(illuminant, folder);
  const double relative = 1e-6;  // of values in the thousands
  int materials = 0;
  for (const auto& row :
       test::csv_rows(test::source_tree / "fixtures/reference/fresnel_gloss_materials.csv")) {
    if (row.text("ext_pts") != "0") {
      continue;  // that program extrapolates by up to 30 nm, this one refuses to
    }
    const auto file = test::source_tree / "fixtures/nk" / row.text("file");
    const Sample sample =
        test::sample_of(folder.path() / "mine.yaml",
                        "{model: smooth, refractive_index: {file: \"" + file.string() + "\"}}");
    for (const std::string geometry : {"20", "60", "85"}) {
      const double expected = row.number("GU" + geometry + "_" + column);
      EXPECT_TRUE(is_close(meter.read(sample.surface, geometry, 1e-6).gloss, expected,
                           0.0051 + relative * expected))
          << row.text("file") << " at " << geometry << " under " << column;
    }
    ++materials;
  }
  EXPECT_EQ(materials, 114);
}

INSTANTIATE_TEST_SUITE_P(Under, MaterialGloss,
                         testing::Values(std::pair{"c", "C"}, std::pair{"d65", "D65"},
                                         std::pair{"a", "A"}, std::pair{"led_b5", "LED-B5"}),
                         [](const auto& test) { return std::string(test.param.first); });

}  // namespace
}  // namespace gonio
