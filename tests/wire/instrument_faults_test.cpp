// Faults of the instrument as a client sees them in registers.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <vector>

#include "emulator/protocol/wire_number.hpp"
#include "tests/wire/server_process.hpp"
#include "tests/wire/tcp_socket.hpp"

namespace gonio::test {
namespace {

/// Bits of registers status and faults.
constexpr unsigned lamp_failed = 1U << 8U, over_range = 1U << 9U;
constexpr unsigned lamp_failure_on = 1, over_range_on = 2, frozen_on = 4, drift_on = 8,
                   tile_dirty_on = 16;

/// What one reads after a measurement.
struct Reading {
  std::uint16_t status, command_state, command_error;
  float gloss_gu;
  std::uint16_t gloss_tenths, state;
};

/// An instrument a thousand times faster than the world, on a server of its own.
class Instrument {
 public:
  explicit Instrument(const std::vector<std::string>& faults = {})
      : server_(arguments(faults)), socket_(server_.port()) {}

  /// @return  registers that function code 4 reads.
  std::vector<std::uint16_t> read(std::uint16_t address, std::uint16_t count) {
    const Bytes reply = ask(fmt::format("04 {:04X} {:04X}", address, count));
    constexpr std::size_t before = 9;
    std::vector<std::uint16_t> words;
    for (std::size_t i = before; i + 1 < reply.size(); i += 2) {
      words.push_back(modbus::u16_at(reply, i));
    }
    words.resize(count);
    return words;
  }
  void write(const std::string& pdu) {
    const Bytes reply = ask(pdu);
    ASSERT_EQ(reply.size(), 12U) << pdu << " -> " << hex(reply);
  }
  /// Starts a command and waits for its end.
  void run(unsigned command) {
    write(fmt::format("06 03E8 {:04X}", command));
    constexpr std::uint16_t command_state = 9, running = 1;
    ASSERT_TRUE(becomes_true([&] { return read(command_state, 1)[0] != running; }));
  }
  Reading measure() {
    run(1);
    const auto words = read(0, 30);
    return {words[0],  words[9],
            words[10], std::bit_cast<float>(std::uint32_t{words[18]} << 16U | words[19]),
            words[24], words[27]};
  }
  /// Register faults, and the magnitudes behind it.
  void set_faults(unsigned bits, float drift = 0.0F, float dirt = 0.0F) {
    write(fmt::format("10 045F 0005 0A {:04X} {:08X} {:08X}", bits,
                      std::bit_cast<std::uint32_t>(drift), std::bit_cast<std::uint32_t>(dirt)));
  }
  void place(unsigned cover) { write(fmt::format("06 044C {:04X}", cover)); }

 private:
  static std::vector<std::string> arguments(const std::vector<std::string>& faults) {
    std::vector<std::string> all = {"--speed", "1000", "--place", "black_glass_n1567"};
    for (const std::string& fault : faults) {
      all.insert(all.end(), {"--fault", fault});
    }
    return all;
  }
  Bytes ask(std::string_view pdu) {
    socket_.send(adu(1, pdu));
    return socket_.receive_adu();
  }

  ServerProcess server_;
  TcpSocket socket_;
};

TEST(InstrumentFaults, LampFailureFailsTheMeasurement) {
  Instrument instrument;
  EXPECT_EQ(instrument.measure().state, 1);
  instrument.set_faults(lamp_failure_on);
  const Reading reading = instrument.measure();
  constexpr std::uint16_t failed = 3, lamp_failure = 7;
  EXPECT_TRUE((reading.status & lamp_failed) != 0);
  EXPECT_EQ(reading.command_state, failed);
  EXPECT_EQ(reading.command_error, lamp_failure);
  instrument.set_faults(0);
  EXPECT_EQ(instrument.measure().state, 1);
}

TEST(InstrumentFaults, OverRangeShowsInEveryFormOfTheReading) {
  Instrument instrument;
  instrument.set_faults(over_range_on);
  const Reading reading = instrument.measure();
  EXPECT_TRUE((reading.status & over_range) != 0);
  EXPECT_TRUE(std::isnan(reading.gloss_gu));
  EXPECT_EQ(reading.gloss_tenths, 0x7FFF);
  EXPECT_EQ(reading.state, 2);
}

TEST(InstrumentFaults, FrozenReadingDoesNotFollowTheSample) {
  Instrument instrument;
  const Reading on_glass = instrument.measure();
  instrument.set_faults(frozen_on);
  instrument.place(0);
  EXPECT_EQ(instrument.measure().gloss_gu, on_glass.gloss_gu);
  instrument.set_faults(0);
  EXPECT_LT(instrument.measure().gloss_gu, 0.1F * on_glass.gloss_gu);
}

TEST(InstrumentFaults, DriftStepScalesTheReading) {
  Instrument instrument;
  const float before_gu = instrument.measure().gloss_gu;
  instrument.set_faults(drift_on, -0.25F);
  constexpr float rounding_gu = 0.05F;  // --ideal shows all digits
  EXPECT_NEAR(instrument.measure().gloss_gu, 0.75F * before_gu, rounding_gu);
}

TEST(InstrumentFaults, DirtyTileIsRefusedAndRaisesAnAlarm) {
  Instrument instrument;
  instrument.place(1);
  instrument.run(2);
  constexpr std::uint16_t done = 2, failed = 3, tile_out_of_tolerance = 6, tile_refused = 4;
  EXPECT_EQ(instrument.read(9, 1)[0], done);
  instrument.set_faults(tile_dirty_on, 0.0F, 0.5F);
  instrument.run(2);
  EXPECT_EQ(instrument.read(9, 2), (std::vector<std::uint16_t>{failed, tile_out_of_tolerance}));
  EXPECT_EQ(instrument.read(4, 1)[0] & tile_refused, tile_refused);
}

TEST(InstrumentFaults, OfTheCommandLineBeginInTime) {
  Instrument instrument({"{fault: over_range, after: 600 s}"});
  EXPECT_EQ(instrument.measure().state, 1);
  EXPECT_TRUE(becomes_true([&] { return instrument.measure().state == 2; }));
  EXPECT_GE(instrument.read(13, 1)[0], 600) << "uptime, s";
}

}  // namespace
}  // namespace gonio::test
