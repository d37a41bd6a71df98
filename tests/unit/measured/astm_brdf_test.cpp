#include "emulator/measured/astm_brdf.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "emulator/core/text_file.hpp"
#include "emulator/measured/brdf_file.hpp"
#include "tests/unit/measured/slice_errors.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio::test {
namespace {

using std::numbers::pi;

BrdfSamples parse(const std::string& text) { return parse_astm(text, "a.astm"); }
std::string error_of(const std::string& text) {
  return message_of([&] { (void)parse(text); });
}

const std::string header = "NUM_POINTS 2\nVARS theta_i,phi_i,theta_s,phi_s,550nm\n";

TEST(AstmBrdf, IsReadWithItsNotes) {
  const BrdfSamples samples =
      parse("LAB_NAME  a laboratory \r\nSAMPLE_NAME \"black tile\"\n# a comment\n" + header +
            "0.5,0,0.25,3.125,1.5\n\n0.5,0,-0.25,3.125,-2e-3\n");
  EXPECT_EQ(samples.notes.at("LAB_NAME"), "a laboratory");
  EXPECT_EQ(samples.notes.at("SAMPLE_NAME"), "black tile");
  EXPECT_EQ(samples.notes.size(), 2u);
  ASSERT_EQ(samples.size(), 2);
  EXPECT_EQ(samples.theta_r[1], -0.25);
  EXPECT_EQ(samples.phi_r[0], 3.125);
  EXPECT_EQ(samples.f_r(1, 0), -2e-3);  // noise is kept
  EXPECT_EQ(samples.channels.at(0).wavelength, nanometres(550.0));
}

TEST(AstmBrdf, TakesColumnsInAnyOrder) {
  const BrdfSamples samples =
      parse("VARS 450nm, phi_s ,theta_s,650nm,THETA_I,phi_i\n1,2,0.3,4,0.5,6\n");
  EXPECT_EQ(samples.theta_i[0], 0.5);
  EXPECT_EQ(samples.phi_i[0], 6.0);
  EXPECT_EQ(samples.theta_r[0], 0.3);
  EXPECT_EQ(samples.phi_r[0], 2.0);
  EXPECT_EQ(samples.f_r(0, 0), 1.0);
  EXPECT_EQ(samples.f_r(0, 1), 4.0);
}

TEST(AstmBrdf, WithoutAzimuthsIsOfThePlaneOfIncidence) {
  const BrdfSamples samples = parse("VARS theta_i,theta_s,BRDF\n0.5,0.5,1\n0.5,-0.5,2\n");
  EXPECT_EQ(samples.phi_i[0], pi);
  EXPECT_EQ(samples.phi_r[0], 0.0);
  EXPECT_EQ(samples.channels.at(0).band, BrdfChannel::Band::luminance);
  const BrdfSamples turned = parse("VARS theta_i,phi_i,theta_s,BRDF\n0.5,1.0,0.5,1\n");
  EXPECT_EQ(turned.phi_r[0], 1.0 - pi);
}

TEST(AstmBrdf, RefusesWhatIsNotSo) {
  EXPECT_EQ(error_of("LAB_NAME x\n"),
            "a.astm:2:1: expected a line VARS with the names of columns, found "
            "'the end of the file'");
  EXPECT_EQ(error_of("12 13\n"),
            "a.astm:1:1: expected a line of a key and a value, NUM_POINTS or VARS, found '12'");
  EXPECT_EQ(error_of("A 1\nA 2\n"), "a.astm:2:1: expected each key once, found 'A'");
  EXPECT_EQ(error_of("NUM_POINTS 1.5\n"),
            "a.astm:1:12: NUM_POINTS: expected a whole number of at least 1, found '1.5'");
  EXPECT_EQ(error_of("NUM_POINTS\n"),
            "a.astm:1:1: NUM_POINTS: expected a whole number of at least 1, found 'NUM_POINTS'");
  EXPECT_EQ(error_of(header + "0,0,0,0,1\n"),
            "a.astm:4:1: expected 2 points, as NUM_POINTS says, rather than 1, found "
            "'the end of the file'");
  EXPECT_EQ(error_of("NUM_POINTS 1e300\n"),
            "a.astm:1:12: NUM_POINTS: expected a whole number of at least 1, found '1e300'");
  EXPECT_EQ(
      error_of("NUM_POINTS 1e15\nVARS theta_i,theta_s,f\n0,0,1\n"),
      "a.astm:4:1: expected 1000000000000000 points, as NUM_POINTS says, rather than 1, found "
      "'the end of the file'");
}

TEST(AstmBrdf, RefusesColumnsThatAreNone) {
  EXPECT_EQ(error_of("VARS theta_i,phi_i,R,G,B\n"),
            "a.astm:1:6: VARS: expected a column theta_s, found 'theta_i,phi_i,R,G,B'");
  EXPECT_EQ(error_of("VARS theta_i,theta_i,R\n"),
            "a.astm:1:14: VARS: expected each column once, found 'theta_i'");
  EXPECT_EQ(error_of("VARS theta_i,theta_s,550nm,550nm\n"),
            "a.astm:1:28: VARS: expected each column once, found '550nm'");
  EXPECT_EQ(error_of("VARS theta_i,theta_s,R,G\n"),
            "a.astm:1:6: VARS: expected channels of one kind: all of R,G,B or X,Y,Z, or "
            "wavelengths, or one luminance, found 'theta_i,theta_s,R,G'");
  EXPECT_EQ(error_of("VARS theta_i,theta_s,R,nonsense\n"),
            "a.astm:1:24: VARS: expected R,G,B or X,Y,Z or wavelengths such as 550nm, or one f_r "
            "of any name, found 'nonsense'");
  EXPECT_NE(error_of("VARS theta_i,theta_s\n").find("expected a column of f_r"), std::string::npos);
  EXPECT_NE(error_of("VARS\n").find("a.astm:1:1: VARS: expected a column theta_i"),
            std::string::npos);
}

TEST(AstmBrdf, RefusesRowsThatAreNone) {
  EXPECT_EQ(error_of(header + "0,0,0,0\n"),
            "a.astm:3:7: expected 5 numbers between commas, found '0'");
  EXPECT_EQ(error_of(header + "0,0,0,0,1,2\n"),
            "a.astm:3:10: expected 5 numbers between commas, found ','");
  EXPECT_EQ(error_of(header + "0,0,x,0,1\n"),
            "a.astm:3:5: expected 5 numbers between commas, found 'x'");
  EXPECT_EQ(error_of(header + "0,0,,0,1\n"),
            "a.astm:3:5: expected 5 numbers between commas, found ','");
  EXPECT_EQ(error_of(header + "0,0,0,0,nan\n"),
            "a.astm:3:9: expected 5 numbers between commas, found 'nan'");
  EXPECT_EQ(error_of(header + "45,0,45,180,1\n"),
            "a.astm:3:1: theta_i: expected an angle in [-1.5708, 1.5708] radians, found '45'");
  EXPECT_EQ(error_of(header + "0,0,0,180,1\n"),
            "a.astm:3:7: phi_s: expected an angle in [-6.2832, 6.2832] radians, found '180'");
}

TEST(AstmBrdf, IsWrittenToTheLastBit) {
  constexpr unsigned seed = 20240607;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> theta(-1.5, 1.5), phi(-3.0, 6.0), log_f_r(-40.0, 8.0);
  BrdfSamples samples;
  samples.notes = {{"SAMPLE_NAME", "a \"satin\" film"},
                   {"EMPTY", ""},
                   {"SYSTEM_NAME", "gonio"},
                   {"QUOTED", "\"x\""}};
  samples.channels = {{.band = BrdfChannel::Band::wavelength, .wavelength = nanometres(405.5)},
                      {.band = BrdfChannel::Band::wavelength, .wavelength = nanometres(550.0)}};
  const auto made = [&](auto& distribution) {
    return Eigen::ArrayXd::NullaryExpr(200, [&] { return distribution(random); }).eval();
  };
  samples.theta_i = made(theta);
  samples.phi_i = made(phi);
  samples.theta_r = made(theta);
  samples.phi_r = made(phi);
  samples.f_r.resize(200, 2);
  samples.f_r.col(0) = made(log_f_r).exp();
  samples.f_r.col(1) = -made(log_f_r).exp();
  const BrdfSamples again = parse(astm_text(samples));
  EXPECT_EQ(again.notes, samples.notes);
  EXPECT_EQ(again.channels, samples.channels);
  EXPECT_TRUE((again.theta_i == samples.theta_i).all());
  EXPECT_TRUE((again.phi_i == samples.phi_i).all());
  EXPECT_TRUE((again.theta_r == samples.theta_r).all());
  EXPECT_TRUE((again.phi_r == samples.phi_r).all());
  EXPECT_TRUE((again.f_r == samples.f_r).all());
  EXPECT_EQ(astm_text(again), astm_text(samples));
}

TEST(AstmBrdf, OfAMaterialIsWhatWasMeasuredAtItsNodes) {
  constexpr double digits_of_file = 2e-5;  // 7 digits of f_r, 6 decimals of angles
  for (const std::string material : {"colodur_napoli_4f", "satin_rosaline"}) {
    const BrdfFile file = load_brdf(brdf_fixtures + material + ".astm");
    for (const double theta_i_deg : {0.0, 20.0, 45.0, 60.0, 75.0}) {
      EXPECT_LT(slice_errors(*file.brdf, material, theta_i_deg).largest, digits_of_file)
          << material << " " << theta_i_deg;
    }
  }
}

TEST(AstmBrdf, OfAMaterialIsNearBetweenItsIncidences) {
  for (const std::string material : {"colodur_napoli_4f", "satin_rosaline"}) {
    const BrdfFile file = load_brdf(brdf_fixtures + material + ".astm");
    const SliceErrors errors = slice_errors(*file.brdf, material, 5.0);  // between 0 and 20
    EXPECT_LT(errors.rms, 0.05) << material;
    EXPECT_LT(errors.of_peak, 0.05) << material;
  }
}

}  // namespace
}  // namespace gonio::test
