#include "emulator/protocol/device_view.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "emulator/protocol/register_codec.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/protocol/scripted_peer.hpp"

namespace gonio {
namespace {

using test::Answer;
using test::Bytes;
using test::message_of;
using testing::ElementsAre;

constexpr auto patient = std::chrono::seconds(10);
constexpr std::size_t most_requests = 16;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

const Point& point(const std::string& id) { return *RegisterMap::standard().find(id); }

std::vector<const Point*> points(const std::vector<std::string>& ids) {
  std::vector<const Point*> result;
  for (const std::string& id : ids) {
    result.push_back(&point(id));
  }
  return result;
}

/// A device that holds what the test puts into its registers, and 0 elsewhere.
class Registers {
 public:
  void set(const std::string& id, double value) {
    const Point& to = point(id);
    encode_number(to, value, words(to));
  }
  void set(const std::string& id, const std::string& text) { encode_text(text, words(point(id))); }
  void set_raw(const std::string& id, std::uint16_t word) { words(point(id))[0] = word; }

  [[nodiscard]] Answer answer(const Bytes& request) const {
    const std::size_t first = std::size_t{request[8]} << 8U | request[9];
    const std::size_t count = std::size_t{request[10]} << 8U | request[11];
    const bool is_bits = request[7] <= 2;
    Bytes data(is_bits ? (count + 7) / 8 : 2 * count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint16_t word = words_[first + i];
      if (is_bits) {
        data[i / 8] = static_cast<std::uint8_t>(data[i / 8] | word << i % 8);
      } else {
        data[2 * i] = static_cast<std::uint8_t>(word >> 8U);
        data[2 * i + 1] = static_cast<std::uint8_t>(word & 0xFFU);
      }
    }
    Bytes frame{request[0], request[1], 0,
                0,          0,          static_cast<std::uint8_t>(data.size() + 3),
                request[6], request[7], static_cast<std::uint8_t>(data.size())};
    frame.insert(frame.end(), data.begin(), data.end());
    return {{frame}};
  }

 private:
  std::span<std::uint16_t> words(const Point& to) {
    return std::span(words_).subspan(to.address, static_cast<std::size_t>(to.registers));
  }
  std::array<std::uint16_t, 65536> words_{};
};

class ADeviceView : public testing::Test {
 protected:
  DeviceView view(const std::vector<const Point*>& of) { return {client(), of}; }
  ModbusClient& client() {
    if (!client_) {
      client_.emplace(DeviceUrl::parse(peer_.url()), patient);
    }
    return *client_;
  }
  /// Function code, first address and count of each request so far.
  [[nodiscard]] std::vector<std::array<int, 3>> requests() const {
    std::vector<std::array<int, 3>> result;
    for (const Bytes& request : peer_.requests()) {
      result.push_back({request[7], request[8] << 8 | request[9], request[10] << 8 | request[11]});
    }
    return result;
  }

  Registers registers;

 private:
  test::TcpPeer peer_{test::Script(
      most_requests, [this](const Bytes& request) { return registers.answer(request); })};
  std::optional<ModbusClient> client_;
};

using Request = std::array<int, 3>;

TEST_F(ADeviceView, GivesValuesByTheirIds) {
  registers.set("gloss_1", 92.3);
  registers.set("gloss_2", nan);
  registers.set("gloss_tenths_1", 92.3);
  registers.set("alarms", 0b101);
  registers.set("state", 3);
  registers.set("test_float_cdab", -123.45);
  registers.set("serial_number", "A4711");
  registers.set("command_error", 4);
  const DeviceView shown = view(points({"gloss_1", "gloss_2", "gloss_tenths_1", "alarms", "state",
                                        "test_float_cdab", "serial_number", "command_error"}));
  EXPECT_EQ(shown.number("gloss_1"), 92.3);  // not 92.30000305175781
  EXPECT_TRUE(std::isnan(shown.number("gloss_2")));
  EXPECT_EQ(shown.number("gloss_tenths_1"), 92.3);
  EXPECT_EQ(shown.number("test_float_cdab"), -123.45);
  EXPECT_EQ(shown.text("gloss_2"), "-");
  EXPECT_EQ(shown.text("state"), "measuring");
  EXPECT_EQ(shown.text("serial_number"), "A4711");
  EXPECT_EQ(shown.meaning("command_error"), "Does not lie on the calibration tile");
  EXPECT_TRUE(shown.bit("alarms", "alarm_restarted"));
  EXPECT_FALSE(shown.bit("alarms", "alarm_lamp_failure"));
  EXPECT_THAT(shown.meanings("alarms"),
              ElementsAre("Power was off, or the instrument was restarted",
                          "The tile differed by more than is allowed"));
}

TEST_F(ADeviceView, TellsOverRangeFromMissing) {
  registers.set("gloss_1", nan);
  registers.set("gloss_2", nan);
  registers.set("reading_state_1", 2);
  registers.set("gloss_tenths_1", std::numeric_limits<double>::infinity());
  const DeviceView shown = view(points_of_blocks({"readings"}));
  EXPECT_EQ(shown.text("gloss_1"), "over range");
  EXPECT_EQ(shown.text("gloss_2"), "-");
  EXPECT_EQ(shown.text("gloss_tenths_1"), "over range");
  EXPECT_EQ(shown.text("difference_1"), "0");
}

TEST_F(ADeviceView, KnowsOnlyWhatItRead) {
  const DeviceView shown = view(points({"state", "model"}));
  EXPECT_TRUE(shown.has("state"));
  EXPECT_FALSE(shown.has("uptime"));
  EXPECT_EQ(message_of([&] { (void)shown.number("uptime"); }), "the point 'uptime' was not read");
  EXPECT_EQ(message_of([&] { (void)shown.number("model"); }), "the point 'model' is text");
}

TEST_F(ADeviceView, ReadsTheSnapshotOfStatusReadingsAndStatisticsInOneRequest) {
  (void)view(points_of_blocks({"statistics", "readings", "status"}));
  EXPECT_THAT(requests(), ElementsAre(Request{4, 0, 72}));
}

TEST_F(ADeviceView, BridgesPointsThatWereNotAskedForButNoHoles) {
  (void)view(points({"range_3", "state"}));
  (void)view(points({"sequence_cdab", "calibration_deviation_1"}));
  EXPECT_THAT(requests(), ElementsAre(Request{4, 1, 71}, Request{4, 112, 2}, Request{4, 200, 2}));
}

TEST_F(ADeviceView, AsksEachTableForItself) {
  registers.set_raw("run_measure", 1);
  registers.set_raw("alarm", 1);
  registers.set("statistics_readings", 7);
  const DeviceView shown = view(points({"run_measure", "alarm", "ready", "statistics_readings"}));
  EXPECT_EQ(shown.number("run_measure"), 1);
  EXPECT_EQ(shown.number("alarm"), 1);
  EXPECT_EQ(shown.number("ready"), 0);
  EXPECT_EQ(shown.text("statistics_readings"), "7");
  EXPECT_THAT(requests(), testing::UnorderedElementsAre(Request{1, 2000, 1}, Request{2, 3000, 11},
                                                        Request{3, 1003, 1}));
}

TEST_F(ADeviceView, NeverReadsMoreThan125RegistersAtOnceAndNeverHalfAPoint) {
  std::vector<std::string> all;
  std::size_t registers_there = 0;
  for (const Block& block : RegisterMap::standard().blocks) {
    all.push_back(block.id);
  }
  const auto everything = points_of_blocks(all);
  (void)view(everything);
  for (const Request& request : requests()) {
    EXPECT_LE(request[2], 125);
    registers_there += static_cast<std::size_t>(request[2]);
    for (const Point* one : everything) {
      const int first = request[1], end = request[1] + request[2];
      EXPECT_FALSE(one->address < end && end <= one->last_address()) << one->id;
      EXPECT_FALSE(one->address < first && first <= one->last_address()) << one->id;
    }
  }
  EXPECT_GT(registers_there, 400U);
}

TEST_F(ADeviceView, FindsAPointByItsAngle) {
  registers.set("angle_1", 20);
  registers.set("angle_2", 60.2);  // as built
  registers.set("angle_3", nan);
  EXPECT_EQ(PointName::parse("lower_limit_60").resolve(client()).id, "lower_limit_2");
  EXPECT_EQ(PointName::parse("gloss_20").resolve(client()).id, "gloss_1");
  EXPECT_EQ(message_of([&] { (void)PointName::parse("gloss_85").resolve(client()); }),
            "gloss_85: expected one of the angles 20, 60.2, found '85'");
}

TEST_F(ADeviceView, AsksForNoAnglesIfAPointIsNamedByItsId) {
  EXPECT_EQ(PointName::parse("gloss_2").resolve(client()).id, "gloss_2");
  EXPECT_TRUE(requests().empty());
}

TEST(PointName, RefusesWhatNoPointIsCalled) {
  for (const std::string text : {"", "gloss", "gloss_", "gloss_x", "_60", "shine_60", "state_20"}) {
    EXPECT_EQ(message_of([&] { (void)PointName::parse(text); }),
              "expected the id of a point, see `gonio registers`, found '" + text + "'");
  }
}

TEST(PointsOfBlocks, RefusesABlockThatIsNone) {
  EXPECT_EQ(message_of([] {
              (void)points_of_blocks({"status", "x"});
            }),
            "the register map has no block 'x'");
}

}  // namespace
}  // namespace gonio
