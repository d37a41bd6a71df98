#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "emulator/procedure/profile.hpp"
#include "emulator/surface/models.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/procedure/laboratory.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

using test::is_close;
using test::shipped;
using test::shipped_standard;

const WavelengthGrid grid(nanometres(400), nanometres(50), 8);

std::vector<ProfileRule> shipped_rules() {
  std::vector<ProfileRule> rules;
  for (const Catalog::Entry& entry : shipped().list(Catalog::Kind::profile)) {
    for (const ProfileRule& rule : load_profile_rules(entry.file, shipped()).rules) {
      rules.push_back(rule);
    }
  }
  return rules;
}

Surface coat(double rms_slope) {
  return cook_torrance(grid, rms_slope, Eigen::ArrayXcd::Constant(grid.size(), 1.567));
}

/// By standard and id, e.g. "astm_e430/11 haze_b".
std::map<std::string, ProfileQuantity> quantities_of(const Surface& surface, double theta_i_deg,
                                                     const ProfileSetup& like = {}) {
  ProfileSetup setup = like;
  setup.theta_i = degrees(theta_i_deg);
  const ProfileScale scale = profile_scale(shipped_standard("iso_2813/2014"), grid);
  const ApertureIntegrator integrator;
  const Profile sample = measure_profile(surface, setup, scale.weight, integrator);
  const Profile reference = measure_profile(scale.reference, setup, scale.weight, integrator);
  std::map<std::string, ProfileQuantity> found;
  for (const ProfileQuantity& quantity :
       profile_quantities(sample, reference, setup.theta_i, shipped_rules(), {})) {
    found.emplace(quantity.standard + " " + quantity.id, quantity);
  }
  return found;
}

const std::vector<std::string> combs{"0.125mm", "0.25mm", "0.5mm", "1mm", "2mm"};

TEST(ProfileQuantities, AreThoseOfTheAngle) {
  const auto at_20 = quantities_of(coat(0.01), 20.0);
  const auto at_30 = quantities_of(coat(0.01), 30.0);
  EXPECT_TRUE(at_20.contains("astm_e430/11 haze_b"));
  EXPECT_TRUE(at_20.contains("iso_13803/2014 log_haze"));
  EXPECT_FALSE(at_20.contains("astm_e430/11 haze_a_narrow"));
  EXPECT_TRUE(at_30.contains("astm_e430/11 haze_a_narrow"));
  EXPECT_TRUE(at_30.contains("astm_e430/11 doi_c"));
  EXPECT_FALSE(at_30.contains("iso_13803/2014 haze"));
  for (const auto& found : {at_20, at_30}) {
    EXPECT_TRUE(found.contains("astm_d5767/95 doi_a"));
    EXPECT_TRUE(found.contains("jis_k_7374/2007 clarity_0.125mm"));
  }
}

TEST(ProfileQuantities, OfASmoothGlassAreThoseOfAPerfectImage) {
  constexpr double rounding = 1e-6;
  const auto found =
      quantities_of(smooth(grid, Eigen::ArrayXcd::Constant(grid.size(), 1.567)), 20.0);
  EXPECT_NEAR(found.at("iso_13803/2014 haze").value.value(), 0.0, rounding);
  EXPECT_NEAR(found.at("iso_13803/2014 log_haze").value.value(), 0.0, rounding);
  EXPECT_NEAR(found.at("astm_d5767/95 doi_a").value.value(), 100.0, rounding);
  for (const std::string& comb : combs) {
    EXPECT_NEAR(found.at("jis_k_7374/2007 clarity_" + comb).value.value(), 100.0, 0.01) << comb;
  }
}

// An even profile has no image. What is left at 20 deg: the cosine of the receptor, which falls by
// 0.6 % per degree.
TEST(ProfileQuantities, OfAMattWhiteAreThoseOfNoImage) {
  constexpr double slope_of_cosine = 0.5;
  const auto found = quantities_of(lambertian(grid, Eigen::ArrayXd::Ones(grid.size())), 20.0);
  EXPECT_NEAR(found.at("astm_d5767/95 doi_a").value.value(), 0.0, slope_of_cosine);
  for (const std::string& comb : combs) {
    EXPECT_NEAR(found.at("jis_k_7374/2007 clarity_" + comb).value.value(), 0.0, slope_of_cosine)
        << comb;
  }
}

TEST(ProfileQuantities, FallWithTheSlopesOfTheSurface) {
  double doi = 100.1;
  double clarity = 100.1;
  for (const double rms_slope : {0.0005, 0.002, 0.008}) {
    const auto found = quantities_of(coat(rms_slope), 20.0);
    EXPECT_LT(found.at("astm_d5767/95 doi_a").value.value(), doi) << rms_slope;
    EXPECT_LT(found.at("jis_k_7374/2007 clarity_0.5mm").value.value(), clarity) << rms_slope;
    doi = *found.at("astm_d5767/95 doi_a").value;
    clarity = *found.at("jis_k_7374/2007 clarity_0.5mm").value;
  }
}

// The haze of a field is what a glossmeter with a receptor there reads, which knows ASTM E430 too
// once its apertures are stated.
TEST(ProfileQuantities, ReadTheHazeThatAGlossmeterOfTheseAperturesReads) {
  constexpr double share = 1e-3;
  const test::TemporaryFolder folder;
  const std::string opening =
      "{source: {in_plane: 0.75 deg, perpendicular: 2.5 deg}, "
      "receptor: {in_plane: 1.8 deg, perpendicular: 3.6 deg}}\n";
  const Instrument instrument = load_instrument(
      folder.file("haze.yaml",
                  "schema: gonio/instrument/1\nid: haze\ntitle: Haze\nbuilt_to: astm_e430/11\n"
                  "geometries: [\"20\", \"20_r18_1\", \"20_r21_9\"]\nas_built:\n  \"20\": " +
                      opening + "  \"20_r18_1\": " + opening + "  \"20_r21_9\": " + opening),
      shipped());
  const Glossmeter meter(instrument, grid, std::make_shared<ApertureIntegrator>());
  ProfileSetup setup;
  setup.source_in_plane = degrees(0.75);
  const Surface surface = coat(0.02);
  const auto found = quantities_of(surface, 20.0, setup);
  const double low = meter.read(surface, "20_r18_1", 1e-6).gloss;
  const double high = meter.read(surface, "20_r21_9", 1e-6).gloss;
  EXPECT_TRUE(
      is_close(found.at("astm_e430/11 haze_b").value.value(), 0.5 * (low + high), share * low));
  EXPECT_TRUE(is_close(found.at("iso_13803/2014 haze").value.value(), low + high, share * low));
}

TEST(ProfileQuantities, SayWhatTheyAssumeAndHowSurelyTheyAreKnown) {
  const auto found = quantities_of(coat(0.01), 20.0);
  EXPECT_EQ(found.at("astm_e430/11 haze_b").assumption, "fields of 1.8 deg");
  EXPECT_EQ(found.at("iso_13803/2014 haze").assumption, "");
  EXPECT_TRUE(found.at("iso_13803/2014 log_haze").evidence.is_informative());
  EXPECT_EQ(found.at("astm_d5767/95 doi_a").evidence.level, "C1");
  EXPECT_EQ(found.at("jis_k_7374/2007 clarity_1mm").evidence.level, "C2");
  EXPECT_EQ(found.at("jis_k_7374/2007 clarity_1mm").assumption, "a focal length of 100 mm");
}

TEST(ProfileQuantities, SayWhyThereIsNoValue) {
  const auto found = quantities_of(coat(0.01), 30.0);
  EXPECT_FALSE(found.at("astm_e430/11 haze_c_wide").value);
  EXPECT_EQ(found.at("astm_e430/11 haze_c_wide").missing, "a field lies beyond the profile");
  const auto dark = quantities_of(lambertian(grid, Eigen::ArrayXd::Zero(grid.size())), 20.0);
  EXPECT_EQ(dark.at("astm_d5767/95 doi_a").missing, "no light at the mirror direction");
}

TEST(LogarithmicHaze, IsTheFormula) {
  for (const ProfileRule& rule : shipped_rules()) {
    if (rule.kind == ProfileRule::Kind::logarithmic) {
      EXPECT_DOUBLE_EQ(logarithmic_haze(rule, 0.0), 0.0);
      EXPECT_DOUBLE_EQ(logarithmic_haze(rule, 20.0), 1285.0 * std::log10(2.0));
    }
  }
}

}  // namespace
}  // namespace gonio
