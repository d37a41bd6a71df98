#include "tests/conformance/mutation/mutation_run.hpp"

#include <gmock/gmock.h>

#include <set>

#include "tests/unit/conformance/mutation/defect_file.hpp"

namespace gonio::conformance {
namespace {

using test::defect;
using test::DefectFile;
using test::harmless;
using test::incidence_off;
using testing::Contains;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TEST(Mutations, CountWhatCatchesThem) {
  const MutationTable table = DefectFile(incidence_off).run();
  EXPECT_TRUE(table.is_sound());
  ASSERT_THAT(table.rows, SizeIs(1));
  std::set<std::string> counted;
  for (const Catch& one : table.rows[0].caught_by) {
    if (one.counts) {
      counted.insert(one.address);
    }
  }
  EXPECT_THAT(counted, ElementsAre("iso_2813/2014/geometry/incidence_60/of_device"));
}

TEST(Mutations, ThatDoNoHarmAreNotCaught) {
  const MutationTable table = DefectFile(harmless).run();
  EXPECT_FALSE(table.is_sound());
  EXPECT_THAT(table.rows[0].caught_by, IsEmpty());
  EXPECT_THAT(mutation_text(table), HasSubstr("0 of 1 defects caught"));
  EXPECT_THAT(mutation_text(table), EndsWith("not caught by the clauses meant to: tried\n"));
}

TEST(Mutations, AreToBeCaughtByAClauseThatIsMeantTo) {
  const MutationTable table =
      DefectFile(defect("set: {as_built: {\"60\": {theta_i: 60.2 deg}}}", "[procedure/rounding]"))
          .run();
  EXPECT_FALSE(table.rows[0].caught_by.empty());
  EXPECT_FALSE(table.rows[0].is_caught);
}

TEST(Mutations, RestOnAHealthyInstrument) {
  const MutationTable table =
      DefectFile(incidence_off, "{as_built: {\"85\": {theta_i: 85.2 deg}}}").run();
  EXPECT_FALSE(table.is_sound());
  EXPECT_THAT(table.healthy_caught_by,
              Contains(HasSubstr("iso_2813/2014/geometry/incidence_85/of_device: fail")));
  EXPECT_THAT(mutation_text(table), HasSubstr("against the healthy instrument: iso_2813"));
}

TEST(Mutations, ComeOutAlikeEveryTime) {
  const DefectFile file(defect("set: {repeatability: 1 GU}", "[procedure/repeatability]"));
  EXPECT_EQ(mutation_text(file.run()), mutation_text(file.run()));
}

}  // namespace
}  // namespace gonio::conformance
