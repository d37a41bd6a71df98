#include "emulator/goniometry/scan_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/unit/standard/shipped_standards.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

using testing::HasSubstr;

std::vector<double> degrees_of(const std::optional<std::vector<Angle>>& angles) {
  std::vector<double> values;
  for (const Angle angle : angles.value_or(std::vector<Angle>{})) {
    values.push_back(angle.degrees());
  }
  return values;
}

TEST(ParseAngles, ReadsListsAndSteps) {
  using testing::DoubleNear;
  using testing::ElementsAre;
  const auto near = [](double value) { return DoubleNear(value, 1e-9); };
  EXPECT_THAT(degrees_of(parse_angles("20 deg, 60 deg")), ElementsAre(near(20), near(60)));
  EXPECT_THAT(degrees_of(parse_angles("-5:5:2.5 deg")),
              ElementsAre(near(-5), near(-2.5), near(0), near(2.5), near(5)));
  EXPECT_THAT(degrees_of(parse_angles("0:10:10deg,45 deg")),
              ElementsAre(near(0), near(10), near(45)));
}

TEST(ParseAngles, RefusesWhatIsNeither) {
  for (const char* text :
       {"", "20", "20 nm", "0:80:5", "0:80:7 deg", "80:0:5 deg", "0:80:0 deg", "0:80 deg",
        "0:1e99:1 deg", "20 deg,", "a:b:c deg", "::: deg", "0:nan:1 deg", "0:80:5 deg deg"}) {
    EXPECT_FALSE(parse_angles(text)) << text;
  }
}

TEST(ParseOpening, ReadsCirclesRectanglesAndNoExtent) {
  EXPECT_EQ(parse_opening("4.7 deg"),
            (ScanOpening{.in_plane = degrees(4.7), .perpendicular = degrees(4.7)}));
  EXPECT_EQ(parse_opening("0.75 deg x 2.5 deg"),
            (ScanOpening{.outline = Aperture::Outline::rectangle,
                         .in_plane = degrees(0.75),
                         .perpendicular = degrees(2.5)}));
  EXPECT_TRUE(parse_opening("collimated")->is_collimated());
  for (const char* text : {"", "0 deg", "-1 deg", "121 deg", "1 deg x", "1 deg x 2 deg x 3 deg",
                           "1", "1 deg x 0 deg", "parallel"}) {
    EXPECT_FALSE(parse_opening(text)) << text;
  }
}

TEST(ParseWavelengthGrid, ReadsSteps) {
  EXPECT_EQ(parse_wavelength_grid("380:780:5 nm"), WavelengthGrid::visible());
  EXPECT_EQ(parse_wavelength_grid("555:555:1 nm")->size(), 1);
  for (const char* text : {"380:780:5", "380:780:7 nm", "0:780:5 nm", "-5:5:5 nm", "380 nm"}) {
    EXPECT_FALSE(parse_wavelength_grid(text)) << text;
  }
}

TEST(ScanPlan, GoesToTheNormalOnce) {
  ScanPlan plan;
  plan.theta_i = {degrees(45)};
  plan.theta_r = {degrees(0), degrees(10)};
  plan.phi_r = {degrees(0), degrees(90), degrees(180)};
  EXPECT_EQ(plan.positions().size(), 4U);
}

TEST(ScanPlan, RefusesMoreThanItMayHold) {
  ScanPlan plan;
  plan.theta_r.assign(1001, degrees(1));
  plan.rotation.assign(1000, degrees(1));
  try {
    (void)plan.positions();
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("3003000 positions at 81 wavelengths were asked for"));
  }
}

TEST(ScanPlan, TakesTheAperturesOfAnInstrument) {
  const ScanPlan plan =
      load_scan_plan(test::shipped().fixture("scans/paper_in_plane.yaml"), test::shipped());
  EXPECT_NEAR(plan.source.in_plane.degrees(), 4.7, 1e-9);
  EXPECT_EQ(plan.source, plan.receptor);
  EXPECT_EQ(plan.instrument, "paper_setup, geometry 60");
  EXPECT_EQ(plan.positions().size(), 3U * 175U);
}

TEST(ScanPlan, OfTheSourceTreeIsRead) {
  for (const char* id : {"in_plane", "hemisphere", "turned"}) {
    const ScanPlan plan = load_scan_plan(
        test::shipped().fixture(std::string("scans/") + id + ".yaml"), test::shipped());
    EXPECT_EQ(plan.id, id);
    EXPECT_FALSE(plan.positions().empty());
  }
}

TEST(ScanPlan, UnsaidIsThatOfTheShippedFile) {
  const ScanPlan unsaid;
  const ScanPlan read =
      load_scan_plan(test::shipped().fixture("scans/in_plane.yaml"), test::shipped());
  EXPECT_EQ(read.source, unsaid.source);
  EXPECT_EQ(read.theta_i, unsaid.theta_i);
  EXPECT_EQ(read.positions().size(), unsaid.positions().size());
}

struct Refused {
  const char* text;  ///< after id and title
  const char* message;
};

class ScanPlanErrors : public testing::TestWithParam<Refused> {};

TEST_P(ScanPlanErrors, NameThePlace) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "plan.yaml";
  std::ofstream(file) << "schema: gonio/scan/1\nid: mine\ntitle: Mine\n" << GetParam().text;
  try {
    (void)load_scan_plan(file, test::shipped());
    FAIL() << "was read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(GetParam().message));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, ScanPlanErrors,
    testing::Values(
        Refused{"receptor: {theta: 0 deg}\n", "source"},
        Refused{"source: {theta: 90 deg}\nreceptor: {theta: 0 deg}\n",
                "plan.yaml:4:17: source.theta: expected angles in [0, 90) deg, found '90 deg'"},
        Refused{"source: {theta: 20}\nreceptor: {theta: 0 deg}\n", "plan.yaml:4:17: source.theta"},
        Refused{"source: {theta: 20 deg}\nreceptor: {theta: [0 deg, 90 deg]}\n",
                "plan.yaml:5:27: receptor.theta"},
        Refused{"source: {theta: 20 deg, aperture: 0 deg}\nreceptor: {theta: 0 deg}\n",
                "plan.yaml:4:35: source.aperture: expected full angles"},
        Refused{"instrument: paper_setup\ngeometry: \"60\"\nsource: {theta: 20 deg, aperture: 1 "
                "deg}\nreceptor: {theta: 0 deg}\n",
                "plan.yaml:6:35: source.aperture: expected no aperture beside"},
        Refused{"instrument: paper_setup\ngeometry: \"61\"\nsource: {theta: 20 deg}\nreceptor: "
                "{theta: 0 deg}\n",
                "plan.yaml:5:11: geometry: expected a geometry of the instrument, found '61'"},
        Refused{"source: {theta: 20 deg}\nreceptor: {theta: 0 deg}\nwavelengths: 380:780:7 nm\n",
                "plan.yaml:6:14: wavelengths"},
        Refused{"source: {theta: 20 deg}\nreceptor: {theta: 0 deg}\npatches: 128\n",
                "plan.yaml:6:10: patches: expected a multiple of 4, with integrator: patches"},
        Refused{"source: {theta: 20 deg}\nreceptor: {theta: 0 deg}\nspeed: fast\n",
                "plan.yaml:6:1: speed"}));

}  // namespace
}  // namespace gonio
