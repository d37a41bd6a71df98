#include "emulator/standard/reading_rule.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/unit/message_of.hpp"
#include "tests/unit/standard/shipped_standards.hpp"

namespace gonio {
namespace {

using test::message_of;
using test::shipped_standard;
using testing::ElementsAre;

ReadingRule rule_of(const std::string& text) {
  return read_reading_rule(YamlNode::parse(text, "r.yaml"));
}

std::string error_of(const std::string& text) {
  return message_of([&] { (void)rule_of(text); });
}

const std::string count = "count: {at_least: 3, evidence: {level: C1, sources: [S]}}\n";
const std::string evidence = ", evidence: {level: memory, sources: []}}\n";

TEST(ReadReadingRule, TakesWhatIsStated) {
  const ReadingRule rule = rule_of(count + "more: {when_range_above: 5 GU, count: 4" + evidence +
                                   "not_uniform: {when_share_above: 0.05" + evidence +
                                   "reject: {range_at_least: 10 GU, share_at_least: 0.2" +
                                   evidence + "report: {values: [mean, range]" + evidence);
  EXPECT_EQ(rule.count.at_least, 3);
  EXPECT_EQ(rule.count.evidence.level, "C1");
  EXPECT_THAT(rule.count.evidence.sources, ElementsAre("S"));
  EXPECT_EQ(rule.count.mark.line, 1);
  EXPECT_EQ(rule.more->when_range_above_gu, 5.0);
  EXPECT_EQ(rule.more->count, 4);
  EXPECT_EQ(rule.more->evidence.level, "memory");
  EXPECT_EQ(rule.more->mark.line, 2);
  EXPECT_EQ(rule.not_uniform->when_share_above, 0.05);
  EXPECT_EQ(rule.reject->range_at_least_gu, 10.0);
  EXPECT_EQ(rule.reject->share_at_least, 0.2);
  EXPECT_EQ(rule.reject->mark.line, 4);
  EXPECT_THAT(rule.report->values, ElementsAre("mean", "range"));
}

TEST(ReadReadingRule, NeedsNoMoreThanTheNumberOfReadings) {
  const ReadingRule rule = rule_of(count);
  EXPECT_FALSE(rule.more);
  EXPECT_FALSE(rule.not_uniform);
  EXPECT_FALSE(rule.reject);
  EXPECT_FALSE(rule.report);
}

TEST(ReadReadingRule, RejectsByRangeOrShareOrBoth) {
  const ReadingRule by_range = rule_of(count + "reject: {range_at_least: 10 GU" + evidence);
  EXPECT_EQ(by_range.reject->range_at_least_gu, 10.0);
  EXPECT_FALSE(by_range.reject->share_at_least);
  const ReadingRule by_share = rule_of(count + "reject: {share_at_least: 0.2" + evidence);
  EXPECT_FALSE(by_share.reject->range_at_least_gu);
  EXPECT_EQ(by_share.reject->share_at_least, 0.2);
}

TEST(ReadReadingRule, RefusesWhatIsNotAsTheSchemaSays) {
  EXPECT_EQ(error_of("report: {values: [mean]" + evidence),
            "r.yaml:1:1: count: expected the key 'count', found 'only report'");
  EXPECT_EQ(error_of("count: {at_least: 0" + evidence),
            "r.yaml:1:19: count.at_least: expected a whole number in [1, 1000], found '0'");
  EXPECT_EQ(error_of("count: {at_least: 3}"),
            "r.yaml:1:8: count.evidence: expected the key 'evidence', found 'only at_least'");
  EXPECT_EQ(error_of(count + "more: {when_range_above: 5" + evidence),
            "r.yaml:2:26: more.when_range_above: expected a gloss value (GU) > 0, found '5'");
  EXPECT_EQ(error_of(count + "more: {count: 3" + evidence),
            "r.yaml:2:7: more.when_range_above: expected the key 'when_range_above', found 'only "
            "count, evidence'");
  EXPECT_EQ(error_of(count + "not_uniform: {when_share_above: 5 GU" + evidence),
            "r.yaml:2:33: not_uniform.when_share_above: expected a number > 0, found '5 GU'");
  EXPECT_EQ(error_of(count + "reject: {evidence: {level: C1, sources: [S]}}"),
            "r.yaml:2:9: reject.share_at_least: expected the key 'share_at_least', found 'only "
            "evidence'");
  EXPECT_EQ(error_of(count + "report: {values: [median]" + evidence),
            "r.yaml:2:19: report.values[0]: expected one of mean, range, found 'median'");
  EXPECT_EQ(error_of(count + "often: yes"),
            "r.yaml:2:1: often: expected one of the keys count, more, not_uniform, reject, report, "
            "found 'often'");
}

TEST(ShippedReadingRules, AreThoseOfTheirStandards) {
  const ReadingRule d523 = shipped_standard("astm_d523/14").readings.value();
  EXPECT_EQ(d523.count.at_least, 3);
  EXPECT_FALSE(d523.count.evidence.is_informative());
  EXPECT_EQ(d523.not_uniform->when_share_above, 0.05);
  EXPECT_TRUE(d523.more->evidence.is_informative());
  EXPECT_FALSE(d523.more->count);
  EXPECT_FALSE(d523.reject);
  const ReadingRule iso = shipped_standard("iso_2813/2014").readings.value();
  EXPECT_EQ(iso.count.at_least + iso.more->count.value(), 6);
  EXPECT_EQ(iso.reject->range_at_least_gu, 10.0);
  EXPECT_EQ(iso.reject->share_at_least, 0.2);
  EXPECT_TRUE(iso.reject->evidence.is_informative());  // of the 1994 edition
  EXPECT_FALSE(shipped_standard("iso_7668/2018").readings);
}

}  // namespace
}  // namespace gonio
