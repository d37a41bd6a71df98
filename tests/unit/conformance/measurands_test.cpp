#include "tests/conformance/measurands.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/unit/conformance/fake_port.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio::conformance {
namespace {

using test::bench_with;
using test::FakePort;
using test::is_close;
using test::message_of;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double rounding = 1e-9;

struct Read {
  Measurement measure;
  MeasurandContext context;
};

/// What a case says under `when`.
Read read_when(const std::string& when) {
  return YamlNode::parse(when, "when.yaml").read_map([](YamlMap& map) {
    Read result;
    const auto reader = measurands().at(map.required("measure").text());
    result.measure = reader(map, result.context);
    return result;
  });
}

/// What it yields with that device, for a clause of one geometry or of none.
std::vector<Finding> measured(const std::string& when, FakePort& port,
                              const std::optional<std::string>& geometry = {}) {
  const ClauseSet set{.id = "iso_2813/2014", .standard = test::iso_2813()};
  const Clause clause{.id = "tried", .geometry = geometry};
  Bench bench = bench_with(port);
  return read_when(when).measure({set, clause, bench});
}

std::vector<double> values_of(const std::vector<Finding>& findings) {
  std::vector<double> values;
  for (const Finding& finding : findings) {
    values.push_back(finding.value.value_or(std::nan("")));
  }
  return values;
}

FakePort with_sample(const std::string& id, std::vector<double> gloss_gu,
                     std::vector<double> scatter = {}) {
  FakePort port;
  port.laid[id] = {.gloss_gu = std::move(gloss_gu), .scatter = std::move(scatter)};
  return port;
}

TEST(Gloss, IsTheMeanReadingInEachGeometry) {
  FakePort port = with_sample("panel", {10.0, 20.0, 30.0}, {-0.3, 0.0, 0.6});
  const auto found = measured("{measure: gloss, sample: panel}", port);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[1].geometry, "60");
  EXPECT_EQ(found[1].subject, "panel");
  EXPECT_TRUE(is_close(*found[1].value, 20.1, rounding));
  EXPECT_GT(found[1].expanded_uncertainty, 0.0);
  EXPECT_EQ(port.count(DeviceCommand::calibrate), 1);
}

TEST(Gloss, OfAClauseOfOneGeometryIsReadThereAlone) {
  FakePort port = with_sample("panel", {10.0, 20.0, 30.0});
  EXPECT_THAT(values_of(measured("{measure: gloss, sample: panel}", port, "85")),
              ElementsAre(30.0));
}

TEST(Gloss, IsNotOfferedInAGeometryThatTheDeviceLacks) {
  FakePort port = with_sample("panel", {10.0, 20.0});
  port.laid["tile"].gloss_gu.pop_back();
  port.known.pop_back();
  EXPECT_THROW((void)measured("{measure: gloss, sample: panel}", port, "85"), NotOffered);
}

TEST(Gloss, OverRangeIsAWordBesideTheFullScale) {
  FakePort port = with_sample("mirror", {2000.0, 900.0, 160.0});
  port.known[0].full_scale_gu = 1000.0;
  const auto found = measured("{measure: gloss, sample: mirror}", port);
  EXPECT_EQ(found[0].text, "over_range");
  EXPECT_EQ(found[0].value, std::nullopt);
  EXPECT_EQ(found[0].full_scale, 1000.0);
  EXPECT_EQ(found[1].value, 900.0);
}

TEST(Gloss, NamesTheSampleThatItNeeds) {
  EXPECT_THAT(read_when("{measure: gloss, sample: panel, readings: 5}").context.samples,
              ElementsAre("panel"));
}

TEST(Gloss, WantsASampleAndSoundCounts) {
  EXPECT_THAT(message_of([] { (void)read_when("{measure: gloss}"); }), HasSubstr("sample"));
  EXPECT_THAT(message_of([] { (void)read_when("{measure: gloss, sample: a, readings: 0}"); }),
              HasSubstr("readings"));
  EXPECT_THAT(message_of([] { (void)read_when("{measure: gloss, sample: a, colour: red}"); }),
              HasSubstr("colour"));
}

TEST(GlossRatio, IsThatOfTheMeans) {
  FakePort port = with_sample("tilted", {50.0, 90.0, 100.0});
  port.laid["flat"] = {.gloss_gu = {100.0, 100.0, 100.0}};
  EXPECT_THAT(values_of(measured("{measure: gloss_ratio, sample: tilted, to: flat}", port)),
              ElementsAre(0.5, 0.9, 1.0));
}

TEST(GlossRatio, LeavesOutWhatIsOverRange) {
  FakePort port = with_sample("tilted", {50.0, 90.0, 100.0});
  port.laid["flat"] = {.gloss_gu = {200.0, 100.0, 200.0}};
  for (PortChannel& channel : port.known) {
    channel.full_scale_gu = 150.0;
  }
  const auto found = measured("{measure: gloss_ratio, sample: tilted, to: flat}", port);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].geometry, "60");
  port.laid["flat"].gloss_gu = {200.0, 200.0, 200.0};
  EXPECT_THROW((void)measured("{measure: gloss_ratio, sample: tilted, to: flat}", port),
               NotOffered);
}

const std::string mirror_line =
    "{measure: linearity, artefacts: [{sample: mirror, fresnel: {reflectance: 1}}]}";

double mirror_gu(double theta_i_deg) {
  return closed_form_gloss({.reflectance = 1.0}, degrees(theta_i_deg), test::iso_2813().scale);
}

TEST(Linearity, IsTheDeviationFromTheClosedFormAsAShareOfFullScale) {
  FakePort port =
      with_sample("mirror", {mirror_gu(20.0) + 20.0, mirror_gu(60.0) - 5.0, mirror_gu(85.0)});
  port.known[0].full_scale_gu = 4000.0;
  port.known[1].full_scale_gu = 1000.0;
  const auto found = measured(mirror_line, port);
  EXPECT_TRUE(is_close(*found[0].value, 0.005, rounding));
  EXPECT_TRUE(is_close(*found[1].value, -0.005, rounding));
  EXPECT_TRUE(is_close(*found[2].value, 0.0, rounding));
}

TEST(Linearity, RestsOnTheIdealMirrorWhereNoFullScaleIsStated) {
  FakePort port = with_sample("mirror", {1.1 * mirror_gu(20.0), mirror_gu(60.0), mirror_gu(85.0)});
  EXPECT_TRUE(is_close(*measured(mirror_line, port)[0].value, 0.1, rounding));
}

TEST(Linearity, IsJudgedAtTheAngleThatTheDeviceStates) {
  FakePort port = with_sample("mirror", {mirror_gu(20.0), mirror_gu(60.0), mirror_gu(85.3)});
  port.incidence[2] = {.value = degrees(85.3)};
  EXPECT_TRUE(is_close(*measured(mirror_line, port)[2].value, 0.0, rounding));
}

TEST(Linearity, LeavesOutWhatMayBeOverRange) {
  FakePort port = with_sample("mirror", {mirror_gu(20.0), mirror_gu(60.0), mirror_gu(85.0)});
  port.known[0].full_scale_gu = 1000.0;
  EXPECT_EQ(measured(mirror_line, port).size(), 2U);
}

TEST(Zero, IsReadOnTheTrapAfterItWasFound) {
  FakePort port;
  port.laid["black_trap"].gloss_gu = {0.1, 0.2, 0.3};
  const auto found = measured("{measure: zero}", port);
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_TRUE(is_close(*found[j].value, port.laid["black_trap"].gloss_gu[j], rounding));
  }
  EXPECT_EQ(port.count(DeviceCommand::zero), 1);
}

TEST(Zero, NotCorrectedIsReadWithoutCommandZero) {
  FakePort port;
  (void)measured("{measure: zero, corrected: false}", port);
  EXPECT_EQ(port.count(DeviceCommand::zero), 0);
  EXPECT_EQ(port.count(DeviceCommand::restart), 1);
  EXPECT_EQ(port.count(DeviceCommand::calibrate), 1);
}

TEST(Drift, IsReadOnTheTileAfterThatTime) {
  FakePort port;
  port.known[1].tile_assigned_gu = 92.4;
  port.drift_per_s = 1.0 / (8 * 3600.0);
  const auto found = measured("{measure: drift, over: 8 h}", port);
  EXPECT_EQ(port.count("pass 28800 s"), 1);
  EXPECT_TRUE(is_close(*found[1].value, 101.0, rounding));
  EXPECT_EQ(found[1].expected, 92.4);
  EXPECT_EQ(found[1].origin, "assigned value of the tile");
}

TEST(WarmUpChange, IsWhatTheTileReadsLaterLessWhatItReadAtOnce) {
  FakePort port;
  port.drift_per_s = 0.5 / 1800.0;
  const auto found = measured("{measure: warm_up_change, settle: 30 min}", port);
  EXPECT_EQ(port.count(DeviceCommand::restart), 1);
  for (const Finding& finding : found) {
    EXPECT_TRUE(is_close(*finding.value, 0.5, rounding));
  }
}

TEST(Refusal, IsWhatTheDeviceSaysWhileItWarmsUp) {
  FakePort port;
  const auto found = measured("{measure: refusal, command: measure, state: warm_up}", port);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].text, "warming_up");
}

TEST(Refusal, IsWhatTheDeviceSaysBeforeItsFirstCalibration) {
  FakePort port;
  EXPECT_EQ(measured("{measure: refusal, command: measure, state: not_calibrated}", port)[0].text,
            "not_calibrated");
}

TEST(Refusal, IsNoneWhereTheDeviceMeasures) {
  FakePort port;
  port.refusals[DeviceCommand::measure] = DeviceError::none;
  EXPECT_EQ(measured("{measure: refusal, command: measure, state: warm_up}", port)[0].text, "none");
}

TEST(CalibrationDue, IsAskedAfterThatTime) {
  FakePort port;
  EXPECT_EQ(measured("{measure: calibration_due, after: 9 h}", port)[0].text, "yes");
  EXPECT_EQ(measured("{measure: calibration_due, after: 1 min}", port)[0].text, "no");
}

TEST(Repeatability, IsTheStandardDeviationOfReadings) {
  FakePort port = with_sample("panel", {10.0, 20.0, 30.0}, {-1.0, 0.0, 1.0});
  for (const double value :
       values_of(measured("{measure: repeatability, sample: panel, readings: 3}", port))) {
    EXPECT_TRUE(is_close(value, 1.0, rounding));
  }
}

TEST(Statistics, OfASoundDeviceAreThoseOfItsReadings) {
  FakePort port = with_sample("a", {10.0, 20.0, 30.0}, {0.0, 0.5});
  port.laid["b"] = {.gloss_gu = {40.0, 60.0, 70.0}};
  const auto found = measured("{measure: statistics, samples: [a, b], readings: 2}", port);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].subject, "a, b");
  EXPECT_EQ(found[0].note, "of 4 readings");
  for (const Finding& finding : found) {
    EXPECT_TRUE(is_close(*finding.value, 0.0, rounding));
  }
}

TEST(Statistics, ThatWereNotClearedDiffer) {
  FakePort port = with_sample("a", {10.0, 20.0, 30.0});
  port.refusals[DeviceCommand::clear_statistics] = DeviceError::none;
  EXPECT_GE(*measured("{measure: statistics, sample: a}", port)[0].value, 1.0);
}

TEST(Statistics, LeaveOutAChannelThatIsOverRange) {
  FakePort port = with_sample("a", {200.0, 20.0, 30.0});
  port.known[0].full_scale_gu = 150.0;
  EXPECT_EQ(measured("{measure: statistics, sample: a}", port).size(), 2U);
}

TEST(SetUp, IsWhatTheDeviceStates) {
  FakePort port;
  port.incidence[1] = {.value = degrees(60.04), .expanded_uncertainty = degrees(0.02)};
  const auto found = measured("{measure: theta_i}", port, "60");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(is_close(*found[0].value, 60.04, rounding));
  EXPECT_TRUE(is_close(found[0].expanded_uncertainty, 0.02, rounding));
  EXPECT_EQ(found[0].unit, "deg");
  EXPECT_EQ(found[0].note, "");
}

TEST(SetUp, StatedWithoutAnUncertaintySaysSo) {
  FakePort port;
  port.incidence[1] = {.value = degrees(60.0)};
  EXPECT_EQ(measured("{measure: theta_i}", port, "60")[0].note, "stated without an uncertainty");
}

TEST(SetUp, IsNotOfferedWhereTheDeviceDoesNotSay) {
  FakePort port;
  EXPECT_EQ(message_of([&] { (void)measured("{measure: receptor_in_plane}", port, "60"); }),
            "the device does not state its receptor_in_plane");
  EXPECT_THROW((void)measured("{measure: image_offset}", port, "60"), NotOffered);
}

TEST(Evaluations, NeedNoDevice) {
  for (const char* when : {"{measure: assigned_value, n: 1.5}",
                           "{measure: selected_geometry, readings: {\"60\": 50 GU}}",
                           "{measure: reported_value, value: 84.5 GU}",
                           "{measure: panel_mean, readings: [85.1 GU]}"}) {
    EXPECT_TRUE(read_when(when).context.is_evaluation) << when;
  }
  EXPECT_FALSE(read_when("{measure: zero}").context.is_evaluation);
}

TEST(AssignedValue, IsThatOfTheGlassInEachGeometry) {
  FakePort port;
  EXPECT_THAT(values_of(measured("{measure: assigned_value, n: 1.567}", port)),
              ElementsAre(100.0, 100.0, 100.0));
  EXPECT_TRUE(port.log.empty());
}

TEST(SelectedGeometry, IsTheOneToReport) {
  FakePort port;
  const auto of = [&](const std::string& gloss) {
    return measured("{measure: selected_geometry, readings: {\"60\": " + gloss + "}}", port)[0]
        .text;
  };
  EXPECT_EQ(of("70.1 GU"), "20");
  EXPECT_EQ(of("70 GU"), "60");
  EXPECT_EQ(of("9.9 GU"), "85");
}

TEST(ReportedValue, IsRoundedByTheStandard) {
  FakePort port;
  EXPECT_EQ(*measured("{measure: reported_value, value: 84.6 GU}", port)[0].value, 85.0);
}

TEST(Panel, IsJudgedByTheRulesOfTheStandard) {
  FakePort port;
  const std::string readings = "readings: [84 GU, 85 GU, 86 GU]}";
  EXPECT_EQ(*measured("{measure: panel_mean, " + readings, port)[0].value, 85.0);
  EXPECT_EQ(*measured("{measure: panel_range, " + readings, port)[0].value, 2.0);
  EXPECT_EQ(measured("{measure: panel_verdict, " + readings, port)[0].text, "accepted");
}

}  // namespace
}  // namespace gonio::conformance
