#include "emulator/measured/ddr_brdf.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "emulator/measured/brdf_reflectance.hpp"
#include "emulator/measured/zemax_brdf.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/measured/slice_errors.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio::test {
namespace {

using std::numbers::pi;

constexpr double rounding = 1e-12;

/// A small table of values 0.5, with things in it replaced, in turn.
std::string table(const std::vector<std::pair<std::string, std::string>>& changes = {}) {
  std::string text =
      ";; a tile\nSource Measured\nTypeSym PlaneSymmetrical\nTypeColorModel BW\n"
      "TypeData Luminance Absolute\nsigma 2\n0 60\nphi 2\n0 180\ntheta 3\n0 90 180\n"
      "kbdf 1 2\ndef\n;; sigma 0\n0.5 0.5 0\n0.5 0.5 0\n;; sigma 60\n0.5 0.5 0\n0.5 0 0\n"
      "enddef\n";
  for (const auto& [what, by] : changes) {
    text.replace(text.find(what), what.size(), by);
  }
  return text;
}

BrdfFile parse(const std::string& text) { return parse_ddr(text, "a.ddr"); }
std::string error_of(const std::string& what, const std::string& by) {
  return message_of([&] { (void)parse(table({{what, by}})); });
}

TEST(DdrBrdf, OfLuminanceIsRelativeToWhiteLambertianReflection) {
  const BrdfFile file = parse(table());
  EXPECT_EQ(file.description, "a tile");
  EXPECT_TRUE(file.warnings.empty());
  EXPECT_TRUE(is_close(in_plane(*file.brdf, 0.0, 20.0)[0], 0.5 / pi, rounding));
  EXPECT_TRUE(is_close(in_plane(*file.brdf, 60.0, 20.0)[0], 1.0 / pi, rounding));  // kbdf is 2
}

TEST(DdrBrdf, OfIntensityIsDividedByTheCosine) {
  const BrdfFile file = parse(table({{"Luminance", "INTENSITY"}}));
  EXPECT_TRUE(is_close(in_plane(*file.brdf, 0.0, 0.0)[0], 0.5, rounding));
  EXPECT_TRUE(is_close(in_plane(*file.brdf, 60.0, 60.0)[0], 2.0 * 0.5 / 0.5, rounding));
}

TEST(DdrBrdf, ThatIsRelativeReflectsWhatKbdfSays) {
  const BrdfFile file = parse(table({{"Absolute", "relative"}, {"kbdf 1 2", "kbdf 0.25 0.75"}}));
  constexpr double rule = 1e-9;  // the same rule scaled it
  EXPECT_TRUE(
      is_close(directional_hemispherical_reflectance(*file.brdf, degrees(0.0))[0], 0.25, rule));
  EXPECT_TRUE(
      is_close(directional_hemispherical_reflectance(*file.brdf, degrees(60.0))[0], 0.75, rule));
  const BrdfFile without = parse(table({{"Absolute", "Relative"}, {"kbdf 1 2\n", ""}}));
  ASSERT_EQ(without.warnings.size(), 1u);
  EXPECT_TRUE(is_close(in_plane(*without.brdf, 0.0, 20.0)[0], 0.5 / pi, rounding));
}

TEST(DdrBrdf, HasChannelsOfColourOrWavelengths) {
  const std::string one = "def\n1 1 0 1 1 0 1 1 0 1 0 0\nenddef\n";
  const std::string two = "kbdf 2 2\ndef\n1 1 0 1 1 0 1 1 0 1 0 0\nenddef\n";
  const std::string table_end = table().substr(table().find("kbdf"));
  const BrdfFile rgb =
      parse(table({{"BW", "rgb"}, {table_end, "blu " + one + "red " + two + "gre " + one}}));
  EXPECT_EQ(rgb.brdf->channels().at(0).band, BrdfChannel::Band::red);
  EXPECT_TRUE(is_close(in_plane(*rgb.brdf, 0.0, 0.0)[0], 2.0 / pi, rounding));
  EXPECT_TRUE(is_close(in_plane(*rgb.brdf, 0.0, 0.0)[2], 1.0 / pi, rounding));
  const BrdfFile spectral =
      parse(table({{"BW", "Spectral 2"}, {table_end, "wl 700 " + one + "wl 400 " + two}}));
  EXPECT_EQ(spectral.brdf->channels().at(0).wavelength, nanometres(400.0));  // they ascend
  EXPECT_TRUE(is_close(in_plane(*spectral.brdf, 0.0, 0.0)[0], 2.0 / pi, rounding));
  EXPECT_EQ(
      message_of([&] {
        (void)parse(table({{"BW", "Spectral 2"}, {table_end, "wl 400 " + one + "wl 400 " + one}}));
      }),
      "a.ddr:15:1: expected each channel once, found 'wl'");
}

TEST(DdrBrdf, TurnsWithPsi) {
  const BrdfFile file = parse(table({{"PlaneSymmetrical", "ASymmetrical 4D"},
                                     {"sigma 2", "psi 2\n0 90\nsigma 2"},
                                     {"0 60", "0 60"},
                                     {"kbdf 1 2", "kbdf 1 1 3 3"},
                                     {"enddef", "0.5 0.5 0 0.5 0.5 0 0.5 0.5 0 0.5 0 0 enddef"}}));
  EXPECT_TRUE(
      is_close(value_of(*file.brdf, direction_at(60, 180), {0, 0, 1})[0], 0.5 / pi, rounding));
  EXPECT_TRUE(
      is_close(value_of(*file.brdf, direction_at(60, 270), {0, 0, 1})[0], 1.5 / pi, rounding));
}

TEST(DdrBrdf, RefusesWhatIsNotSo) {
  EXPECT_EQ(error_of("PlaneSymmetrical", "Round"),
            "a.ddr:3:9: expected AxiSymmetrical, DirSymmetrical, PlaneSymmetrical or ASymmetrical, "
            "found 'Round'");
  EXPECT_EQ(error_of("BW", "HSV"), "a.ddr:4:16: expected BW, RGB or spectral, found 'HSV'");
  EXPECT_EQ(error_of("Luminance", "Radiance"),
            "a.ddr:5:10: expected Luminance or Intensity, found 'Radiance'");
  EXPECT_EQ(error_of("Absolute", "Fair"),
            "a.ddr:5:20: expected Absolute or Relative, found 'Fair'");
  EXPECT_EQ(error_of("phi 2", "sigmat 0 58\nphi 2"),
            "a.ddr:8:10: sigmat: expected the angle of incidence: lobes that are off the mirror "
            "direction are not read, found '58'");
  EXPECT_EQ(error_of("phi 2", "sigmat 0 60\nphi 2"), "no error");
  EXPECT_EQ(error_of("theta 3\n0 90 180\n", ""),
            "a.ddr:10:1: expected theta before the data, found 'kbdf'");
  EXPECT_EQ(error_of("kbdf 1 2", "kbdf 1 -2"),
            "a.ddr:12:8: kbdf: expected a factor of at least 0, found '-2'");
  EXPECT_EQ(error_of("kbdf 1 2", "kbdf 1"), "a.ddr:13:1: kbdf: expected a number, found 'def'");
  EXPECT_EQ(error_of("enddef\n", ""), "a.ddr:20:1: expected enddef, found 'the end of the file'");
  EXPECT_EQ(error_of("enddef\n", "enddef\ndef\n"),
            "a.ddr:21:1: expected the end of the file after the last enddef, found 'def'");
  EXPECT_EQ(error_of("0.5 0 0", "0.5 0 x"), "a.ddr:19:7: expected a number, found 'x'");
  EXPECT_EQ(error_of("BW", "Spectral 1000000000"),
            "a.ddr:4:25: TypeColorModel: expected a number of values, from 1 to what the file can "
            "hold, found '1000000000'");
}

TEST(DdrBrdf, ClipsNegativeValuesAndCountsThem) {
  const BrdfFile file = parse(table({{"0.5 0 0", "0.5 -1 0"}}));
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_EQ(file.warnings[0], "1 of 12 values are negative: 0 stands for them");
}

TEST(DdrBrdf, OfAMaterialIsWhatItsZemaxFileIs) {
  constexpr double digits_of_file = 3e-5;
  for (const std::string material : {"colodur_napoli_4f", "satin_rosaline"}) {
    const BrdfFile ddr = read_ddr(brdf_fixtures + material + ".ddr");
    const BrdfFile zemax = read_zemax(brdf_fixtures + material + ".zemax.bsdf");
    EXPECT_TRUE(ddr.warnings.empty());
    for (const double theta_r_deg : {-70.0, -20.0, 0.0, 31.0, 45.0, 47.0, 58.0, 80.0}) {
      const double got = in_plane(*ddr.brdf, 47.0, theta_r_deg)[0];
      EXPECT_TRUE(
          is_close_relative(got, in_plane(*zemax.brdf, 47.0, theta_r_deg)[0], digits_of_file));
    }
  }
}

}  // namespace
}  // namespace gonio::test
