#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/system/program.hpp"

namespace gonio {
namespace {

using test::contents;
using test::Outcome;
using test::Program;
using testing::HasSubstr;

TEST(Validate, GivesTheFiguresOfItsReference) {
  const Program program;
  const Outcome outcome = program.run({"validate", "--report", "page"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out, contents(test::source_tree / "reports/reference/validation.txt"));
  EXPECT_EQ(contents(program.folder() / "page/validation.txt"), outcome.out);
  EXPECT_THAT(contents(program.folder() / "page/validation.html"), HasSubstr("<svg"));
  EXPECT_THAT(contents(program.folder() / "page/validation.json"),
              HasSubstr("\"schema\": \"gonio/validation_result/1\""));
}

TEST(Validate, RefusesABadPlan) {
  const Program program;
  (void)program.file("plan.yaml", "schema: gonio/validation/1\nid: a b\n");
  const Outcome outcome = program.run({"validate", "plan.yaml", "--report", "page"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("plan.yaml:2:5: id: expected"));
  EXPECT_EQ(outcome.out, "");
  EXPECT_FALSE(std::filesystem::exists(program.folder() / "page"));
}

}  // namespace
}  // namespace gonio
