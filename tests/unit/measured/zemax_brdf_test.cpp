#include "emulator/measured/zemax_brdf.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/unit/expect_close.hpp"
#include "tests/unit/measured/slice_errors.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio::test {
namespace {

using std::numbers::pi;

constexpr double rounding = 1e-12;

/// A small table of white Lambertian reflection, with something in it replaced.
std::string table(const std::string& what = "", const std::string& by = "") {
  std::string text =
      "# a tile\nSource Measured by hand\nSymmetry PlaneSymmetrical\n"
      "SpectralContent Monochrome\nScatterType BRDF\nSampleRotation 1\n0\n"
      "AngleOfIncidence 2\n0 60\nScatterAzimuth 2\n0 180\nScatterRadial 3\n0 90 180\n"
      "Monochrome\nDataBegin\nTIS 1\n0.31831 0.31831 0\n0.31831 0.31831 0\n"
      "TIS 1\n0.31831 0.31831 0\n0.31831 0 0\nDataEnd\n";
  if (const std::size_t at = text.find(what); !what.empty() && at != std::string::npos) {
    text.replace(at, what.size(), by);
  }
  return text;
}

BrdfFile parse(const std::string& text) { return parse_zemax(text, "a.bsdf"); }
std::string error_of(const std::string& what, const std::string& by) {
  return message_of([&] { (void)parse(table(what, by)); });
}

TEST(ZemaxBrdf, IsReadAboutTheMirrorDirection) {
  const BrdfFile file = parse(table("0.31831 0.31831 0\n", "5 0.31831 0\n"));
  EXPECT_EQ(file.description, "a tile");
  EXPECT_EQ(file.format, BrdfFormat::zemax);
  EXPECT_TRUE(is_close(in_plane(*file.brdf, 60.0, 60.0)[0], 0.31831, rounding));
  EXPECT_TRUE(is_close(in_plane(*file.brdf, 0.0, -45.0)[0],
                       std::pow((std::pow(5.0, 0.25) + std::pow(0.31831, 0.25)) / 2.0, 4.0), 1e-9));
}

TEST(ZemaxBrdf, TakesKeywordsInAnyCase) {
  EXPECT_EQ(message_of([] { (void)parse(table("Symmetry Plane", "SYMMETRY plane")); }), "no error");
}

TEST(ZemaxBrdf, TellsOfATisThatIsNotItsTables) {
  EXPECT_TRUE(parse(table()).warnings.empty());
  const BrdfFile file = parse(table("TIS 1\n", "TIS 0.5\n"));
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_EQ(file.warnings[0], "the TIS at 0 deg is given as 0.5, but its table gives 1");
}

TEST(ZemaxBrdf, ClipsNegativeValuesAndCountsThem) {
  const BrdfFile file = parse(table("0.31831 0 0\n", "0.31831 -1 -1\n"));
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_EQ(file.warnings[0], "2 of 12 values are negative: 0 stands for them");
}

TEST(ZemaxBrdf, HasThreeChannelsOfColour) {
  const std::string rows =
      "TIS 1\n0.31831 0.31831 0\n0.31831 0.31831 0\nTIS 1\n0.31831 0.31831 0\n"
      "0.31831 0 0\nDataEnd\n";
  const auto colour = [&](const std::string& first, const std::string& second) {
    return "Symmetry PlaneSymmetrical\nSpectralContent XYZ\nScatterType BRDF\n"
           "AngleOfIncidence 2\n0 60\nScatterAzimuth 2\n0 180\nScatterRadial 3\n0 90 180\n" +
           first + "\nDataBegin\n" + rows + second + "\nDataBegin\n" + rows +
           "TristimulusZ\nDataBegin\nTIS 0\n" + "0 0 0 0 0 0\nTIS 0\n0 0 0 0 0 0\nDataEnd\n";
  };
  const BrdfFile file = parse(colour("TristimulusY", "TristimulusX"));
  const Eigen::ArrayXd xyz = in_plane(*file.brdf, 60.0, 0.0);
  EXPECT_EQ(file.brdf->channels().at(2).band, BrdfChannel::Band::z);
  EXPECT_TRUE(is_close(xyz[0], 0.31831, rounding));
  EXPECT_EQ(xyz[2], 0.0);
  EXPECT_EQ(message_of([&] { (void)parse(colour("TristimulusX", "TristimulusX")); }),
            "a.bsdf:19:1: expected each keyword once, found 'TristimulusX'");
}

TEST(ZemaxBrdf, RefusesWhatIsNotSo) {
  EXPECT_EQ(error_of("ScatterType BRDF", "ScatterType BTDF"),
            "a.bsdf:5:13: ScatterType: expected BRDF: transmitted light is not read, found "
            "'BTDF'");
  EXPECT_EQ(error_of("PlaneSymmetrical", "Asymmetric"),
            "a.bsdf:3:10: expected PlaneSymmetrical, Asymmetrical or ASymmetrical4D of Zemax "
            "(this is a BSDF of LightTools, which is not read), found 'Asymmetric'");
  EXPECT_EQ(error_of("TIS 1", "AOI 0"),
            "a.bsdf:16:1: expected TIS of Zemax (this is a BSDF of LightTools, which is not "
            "read), found 'AOI'");
  EXPECT_EQ(error_of("SpectralContent Monochrome\n", ""),
            "a.bsdf:13:1: expected SpectralContent before the data, found 'Monochrome'");
  EXPECT_EQ(error_of("0 60", "60 0"),
            "a.bsdf:9:4: AngleOfIncidence: expected an angle above 60: they ascend, found '0'");
  EXPECT_EQ(error_of("0 60", "0 91"),
            "a.bsdf:9:3: AngleOfIncidence: expected an angle in [0, 90] degrees, found '91'");
  EXPECT_EQ(error_of("0 180\nScatterR", "0 190\nScatterR"),
            "a.bsdf:14:1: ScatterAzimuth: expected azimuths to 180 degrees where the symmetry is "
            "PlaneSymmetrical, found 'Monochrome'");
  EXPECT_EQ(error_of("Source", "Nonsense"),
            "a.bsdf:2:1: expected a keyword of the header, found 'Nonsense'");
  EXPECT_EQ(error_of("ScatterType BRDF", "Symmetry PlaneSymmetrical"),
            "a.bsdf:5:1: expected each keyword once, found 'Symmetry'");
}

TEST(ZemaxBrdf, RefusesTablesThatAreTooShortOrTooLong) {
  EXPECT_EQ(error_of("0.31831 0 0\n", "0.31831 0\n"),
            "a.bsdf:22:1: expected a number, found 'DataEnd'");
  EXPECT_EQ(error_of("0.31831 0 0\n", "0.31831 0 0 0\n"),
            "a.bsdf:21:13: expected DataEnd, found '0'");
  EXPECT_EQ(error_of("DataEnd\n", ""),
            "a.bsdf:22:1: expected DataEnd, found "
            "'the end of the file'");
  EXPECT_EQ(error_of("DataEnd\n", "DataEnd\nMonochrome\n"),
            "a.bsdf:23:1: expected the end of the file after the last DataEnd, found "
            "'Monochrome'");
  EXPECT_EQ(error_of("0.31831 0 0\n", "0.31831 nan 0\n"),
            "a.bsdf:21:9: expected a number, found 'nan'");
}

TEST(ZemaxBrdf, AllocatesNothingForCountsThatItsFileCannotHold) {
  EXPECT_EQ(error_of("ScatterRadial 3", "ScatterRadial 2000000000"),
            "a.bsdf:12:15: ScatterRadial: expected a number of values, from 1 to what the file can "
            "hold, found '2000000000'");
  const std::string claims =
      table("AngleOfIncidence 2\n0 60", "AngleOfIncidence 13\n0 1 2 3 4 5 6 7 8 9 10 11 12");
  EXPECT_EQ(message_of([&] { (void)parse(claims); }),
            "a.bsdf:14:1: DataBegin: expected 78 numbers, found 'Monochrome'");
}

TEST(ZemaxBrdf, OfAMaterialIsNearWhatWasMeasured) {
  struct Expected {
    const char* material;
    double rms_45, rms_75;
  };
  // the steps of the table, 1 deg near the mirror direction to 15 deg and more, set the error
  for (const auto& [material, rms_45, rms_75] :
       {Expected{"colodur_napoli_4f", 0.04, 0.09}, Expected{"satin_rosaline", 0.05, 0.18}}) {
    const BrdfFile file = read_zemax(brdf_fixtures + material + ".zemax.bsdf");
    EXPECT_TRUE(file.warnings.empty()) << file.warnings.front();
    EXPECT_LT(slice_errors(*file.brdf, material, 45.0).rms, rms_45) << material;
    EXPECT_LT(slice_errors(*file.brdf, material, 75.0).rms, rms_75) << material;
    for (const double theta_i_deg : {0.0, 20.0, 45.0, 60.0, 75.0}) {
      constexpr double peak = 0.013;  // luminance weights, and the grids of RGL at the very peak
      EXPECT_LT(slice_errors(*file.brdf, material, theta_i_deg).of_peak, peak) << theta_i_deg;
    }
  }
}

}  // namespace
}  // namespace gonio::test
