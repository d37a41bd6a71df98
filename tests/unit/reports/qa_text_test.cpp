#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "reports/qa_report.hpp"
#include "tests/unit/reports/hostile_qa.hpp"

namespace gonio {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(QaText, OpensWithTheVerdict) {
  EXPECT_THAT(qa_text(test::example_qa(), false), StartsWith("fail: Of 3 lots inspected"));
  EXPECT_THAT(qa_text(test::example_qa(), true), StartsWith("\033[1mfail\033[0m: "));
}

TEST(QaText, HasWhatWasAskedAndWhereItIsStored) {
  const std::string text = qa_text(test::example_qa(), false);
  EXPECT_THAT(text, HasSubstr("4 readings of a panel keep both risks of a lot below 5 % (now 3)."));
  EXPECT_THAT(text, HasSubstr("The roughness may vary by 3.1 %"));
  EXPECT_THAT(text, HasSubstr("run 7 in sqlite:qa.db; seed 20260101\n"));
}

TEST(QaText, LeavesOutWhatIsNotThere) {
  const std::string text = qa_text(test::empty_qa(), false);
  for (const char* title : {"Capability", "Control charts", "Gauge R&R", "Risks", "What was asked",
                            "Remarks", "Lots"}) {
    EXPECT_THAT(text, Not(HasSubstr(std::string("\n") + title))) << title;
  }
  EXPECT_THAT(text, HasSubstr("run 1 in no store"));
}

TEST(QaText, HasADashForWhatIsNotKnown) {
  const std::string text = qa_text(test::bare_qa(), false);
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  EXPECT_THAT(text, HasSubstr("gloss at 60   -    -   -    -"));
}

TEST(QaText, ShowsTheFirstOfManyLots) {
  QaResult result = test::example_qa();
  result.lots_accepted = 1000;
  result.lots.resize(100);
  EXPECT_THAT(qa_text(result, false), HasSubstr("Lots, the first 20 of 1002\n"));
}

TEST(QaText, HoldsHostileTextInItsLines) {
  const std::string text = qa_text(test::hostile_qa(test::hostile_text("trace")), false);
  EXPECT_THAT(text, Not(HasSubstr("\x1B")));
  EXPECT_THAT(text, Not(HasSubstr("\n# head")));
}

}  // namespace
}  // namespace gonio
