#include "tests/conformance/mutation/defect.hpp"

#include <gmock/gmock.h>

#include <set>

#include "tests/unit/conformance/mutation/defect_file.hpp"

namespace gonio::conformance {
namespace {

using test::defect;
using test::DefectFile;
using test::harmless;
using test::incidence_off;
using testing::HasSubstr;
using testing::SizeIs;

const std::filesystem::path shipped_defects =
    test::source_tree / "tests/conformance/mutation/defects.yaml";

TEST(Defects, AreReadWithTheirPlace) {
  const Defects all = DefectFile(incidence_off).read();
  ASSERT_THAT(all.defects, SizeIs(1));
  EXPECT_EQ(all.defects[0].id, "tried");
  EXPECT_EQ(all.defects[0].mark.line, 5);
  EXPECT_EQ(all.defects[0].standards, std::vector<std::string>{"iso_2813/2014"});
}

TEST(Defects, AreKnownByName) {
  EXPECT_THAT(DefectFile(defect("device: haunted")).error(),
              HasSubstr("defects.yaml:5:74: defects[0].device: expected one of"));
  EXPECT_THAT(DefectFile(defect("optics: haunted")).error(), HasSubstr("cosine_missing"));
  EXPECT_THAT(DefectFile(defect("standard: {haunted: true}")).error(), HasSubstr("haunted"));
}

TEST(Defects, AreWrongSomewhere) {
  EXPECT_EQ(
      DefectFile("  - {id: a, wrong: Nothing, clauses: [x]}\n").error(),
      "defects.yaml:5:5: defects[0]: expected one of set, unstated, certificate_index, optics, "
      "device, standard, found 'none'");
}

TEST(Defects, AreThereOnce) {
  EXPECT_THAT(DefectFile(harmless + harmless).error(),
              HasSubstr("defects[1].id: expected each defect once, found 'tried'"));
}

TEST(Defects, AreTriedOnTheirInstrumentWhenTheyAreRead) {
  EXPECT_THAT(DefectFile(defect("set: {as_built: {\"45\": {theta_i: 45 deg}}}")).error(),
              HasSubstr("expected a geometry of iso_2813/2014"));
  EXPECT_THAT(DefectFile(harmless, "{colour: red}").error(), HasSubstr("healthy"));
}

TEST(ShippedDefects, AreManyAndTryAllThatIsNamed) {
  constexpr std::size_t least = 30;
  const Defects all = load_defects(shipped_defects, test::shipped());
  EXPECT_GE(all.defects.size(), least);
  std::set<PortDefect> of_devices;
  std::set<OpticsDefect> of_optics;
  for (const Defect& one : all.defects) {
    of_devices.insert(one.device);
    of_optics.insert(one.optics);
  }
  for (const auto& [name, change] : port_defects()) {
    EXPECT_TRUE(of_devices.contains(change)) << name;
  }
  for (const auto& [name, change] : optics_defects()) {
    EXPECT_TRUE(of_optics.contains(change)) << name;
  }
}

}  // namespace
}  // namespace gonio::conformance
