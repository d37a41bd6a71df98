#include "emulator/instrument/settings.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <system_error>

#include "emulator/core/input_error.hpp"
#include "emulator/core/text_file.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/standard/shipped_standards.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

using test::message_of;
using test::replaced;
using test::TemporaryFolder;

const std::vector<std::string> ids{"20", "60"};

DeviceSettings awkward() {
  return {.mode = MeasuringMode::pass_fail,
          .statistics_readings = 999,
          .interval_s = 0.1 + 0.2,
          .has_reference = true,
          .channels = {{.reference_gu = 1.0 / 3.0,
                        .lower_limit_gu = -1e-300,
                        .upper_limit_gu = 9999.999999999998,
                        .tile_gu = 93.60000000000001,
                        .is_measured = false},
                       {.reference_gu = 5e-324, .tile_gu = 1e-17}}};
}

DeviceSettings usual() { return {.channels = {{}, {}}}; }

// Round trip.

TEST(DeviceSettingsFile, GivesBackWhatWasSavedToTheLastBit) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "settings.yaml";
  for (const DeviceSettings& settings : {usual(), awkward()}) {
    save_settings(path, settings, ids);
    EXPECT_EQ(load_settings(path, ids), settings);
  }
}

TEST(DeviceSettingsFile, KeepsEveryMode) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "settings.yaml";
  for (const MeasuringMode mode :
       {MeasuringMode::single, MeasuringMode::statistics, MeasuringMode::continuous,
        MeasuringMode::difference, MeasuringMode::pass_fail}) {
    DeviceSettings settings = usual();
    settings.mode = mode;
    save_settings(path, settings, ids);
    EXPECT_EQ(load_settings(path, ids).mode, mode);
  }
}

TEST(DeviceSettingsFile, IsOneThatPeopleCanRead) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "settings.yaml";
  save_settings(path, usual(), ids);
  EXPECT_EQ(read_text_file(path),
            "schema: gonio/settings/1\n"
            "mode: single\n"
            "statistics_readings: 5\n"
            "interval: 1 s\n"
            "has_reference: false\n"
            "channels:\n"
            "  \"20\": {reference: 0 GU, lower_limit: 0 GU, upper_limit: 2000 GU, tile: 100 GU, "
            "measured: true}\n"
            "  \"60\": {reference: 0 GU, lower_limit: 0 GU, upper_limit: 2000 GU, tile: 100 GU, "
            "measured: true}\n");
}

// What is refused.

struct Spoilt {
  std::string what;  ///< as out_of_range() names it
  std::function<void(DeviceSettings&)> spoil;
};

const double nan = std::numeric_limits<double>::quiet_NaN();
const double infinity = std::numeric_limits<double>::infinity();

std::vector<Spoilt> spoilt_settings() {
  const auto interval = [](double value) {
    return Spoilt{"interval_s", [=](DeviceSettings& s) { s.interval_s = value; }};
  };
  const auto of_channel = [](const std::string& name, double DeviceSettings::ByChannel::*member,
                             double value) {
    return Spoilt{"channels[1]." + name, [=](DeviceSettings& s) { s.channels[1].*member = value; }};
  };
  using ByChannel = DeviceSettings::ByChannel;
  std::vector<Spoilt> all{
      {"mode", [](DeviceSettings& s) { s.mode = MeasuringMode(5); }},
      {"mode", [](DeviceSettings& s) { s.mode = MeasuringMode(-1); }},
      {"statistics_readings", [](DeviceSettings& s) { s.statistics_readings = 0; }},
      {"statistics_readings", [](DeviceSettings& s) { s.statistics_readings = 1000; }},
      {"channels", [](DeviceSettings& s) { s.channels.pop_back(); }},
      {"channels", [](DeviceSettings& s) { s.channels.emplace_back(); }},
      {"channels[0].is_measured",
       [](DeviceSettings& s) { s.channels[0].is_measured = s.channels[1].is_measured = false; }},
      interval(0.0999),
      interval(3600.1),
      interval(nan),
      interval(infinity),
      of_channel("upper_limit_gu", &ByChannel::upper_limit_gu, -0.1),  // below the lower limit
      of_channel("tile_gu", &ByChannel::tile_gu, 0.0)};
  for (const double value : {-10'000.1, 10'000.1, nan, infinity, -infinity}) {
    all.push_back(of_channel("reference_gu", &ByChannel::reference_gu, value));
    all.push_back(of_channel("lower_limit_gu", &ByChannel::lower_limit_gu, value));
    all.push_back(of_channel("upper_limit_gu", &ByChannel::upper_limit_gu, value));
    all.push_back(of_channel("tile_gu", &ByChannel::tile_gu, value));
  }
  return all;
}

TEST(DeviceSettingsRange, NamesTheFirstValueThatIsOutOfIt) {
  EXPECT_EQ(out_of_range(usual(), 2), std::nullopt);
  EXPECT_EQ(out_of_range(awkward(), 2), std::nullopt);
  for (const Spoilt& spoilt : spoilt_settings()) {
    DeviceSettings settings = usual();
    spoilt.spoil(settings);
    EXPECT_EQ(out_of_range(settings, 2), spoilt.what);
  }
}

TEST(DeviceSettingsFile, IsNotWrittenForSettingsOutOfTheirRange) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "settings.yaml";
  save_settings(path, usual(), ids);
  for (const Spoilt& spoilt : spoilt_settings()) {
    DeviceSettings settings = usual();
    spoilt.spoil(settings);
    EXPECT_THROW(save_settings(path, settings, ids), std::invalid_argument) << spoilt.what;
  }
  EXPECT_EQ(load_settings(path, ids), usual());
}

TEST(DeviceSettingsFile, ThatCannotBeWrittenIsToldWithItsPath) {
  EXPECT_THROW(save_settings("no/such/folder/settings.yaml", usual(), ids), std::system_error);
}

struct Refused {
  std::string from, to;  ///< in the file of usual()
  std::string message;   ///< after the name of the file
};

TEST(DeviceSettingsFile, RefusesWhatIsNotAsTheSchemaSays) {
  const std::vector<Refused> table{
      {"settings/1", "settings/2",
       ":1:9: schema: expected gonio/settings/1, found 'gonio/settings/2'"},
      {"mode: single", "mode: double",
       ":2:7: mode: expected one of single, statistics, continuous, difference, pass_fail, found "
       "'double'"},
      {"mode: single\n", "",
       ":1:1: mode: expected the key 'mode', found 'only schema, statistics_readings, interval, "
       "has_reference, channels'"},
      {"readings: 5", "readings: 1000",
       ":3:22: statistics_readings: expected a whole number in [1, 999], found '1000'"},
      {"readings: 5", "readings: 4.5",
       ":3:22: statistics_readings: expected a whole number in [1, 999], found '4.5'"},
      {"1 s", "0 s",
       ":4:11: interval: expected a time (s, ms, min, h) in [0.1, 3600], found '0 s'"},
      {"false", "no", ":5:16: has_reference: expected one of true, false, found 'no'"},
      {"\"60\"", "\"85\"", ":7:3: channels.60: expected the key '60', found 'only 20, 85'"},
      {"reference: 0 GU", "reference: nan GU",
       ":7:21: channels.20.reference: expected a gloss value (GU) in [-10000, 10000], found 'nan "
       "GU'"},
      {"upper_limit: 2000 GU", "upper_limit: -1 GU",
       ":7:59: channels.20.upper_limit: expected a gloss value (GU) in [0, 10000], found '-1 GU'"},
      {"tile: 100 GU", "tile: 0 GU",
       ":7:74: channels.20.tile: expected a gloss value (GU) in (0, 10000], found '0 GU'"},
      {"mode:", "colour: red\nmode:",
       ":2:1: colour: expected one of the keys channels, has_reference, interval, mode, schema, "
       "statistics_readings, found 'colour'"}};
  const TemporaryFolder folder;
  const auto path = folder.path() / "settings.yaml";
  save_settings(path, usual(), ids);
  const std::string text = read_text_file(path);
  for (const Refused& row : table) {
    (void)folder.file("settings.yaml", replaced(text, row.from, row.to));
    EXPECT_EQ(message_of([&] { (void)load_settings(path, ids); }), path.string() + row.message);
  }
}

TEST(DeviceSettingsFile, NeedsAChannelThatIsMeasured) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "settings.yaml";
  save_settings(path, usual(), ids);
  const std::string text =
      replaced(replaced(read_text_file(path), "measured: true", "measured: false"),
               "measured: true", "measured: false");
  (void)folder.file("settings.yaml", text);
  EXPECT_EQ(message_of([&] { (void)load_settings(path, ids); }),
            path.string() + ":7:3: channels: expected a channel that is measured, found 'none'");
}

TEST(DeviceSettingsFile, ThatIsCutOffAnywhereIsRefused) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "settings.yaml";
  save_settings(path, usual(), ids);
  const std::string text = read_text_file(path);
  for (std::size_t size = 0; size + 2 < text.size(); ++size) {
    (void)folder.file("settings.yaml", text.substr(0, size));
    EXPECT_THROW((void)load_settings(path, ids), InputError) << size;
  }
}

// A process that saves all the time, one of two settings after the other, is killed at any moment.

/// Saves for ever and writes a byte after each; never returns.
[[noreturn]] void save_for_ever(const std::filesystem::path& path, int pipe) {
  try {
    for (;;) {
      for (const DeviceSettings& settings : {usual(), awkward()}) {
        save_settings(path, settings, ids);
        if (write(pipe, "s", 1) != 1) {
          _exit(1);
        }
      }
    }
  } catch (...) {
    _exit(2);
  }
}

/// Lets the child save `saves` times, and spins that long, before it is killed.
void kill_while_saving(const std::filesystem::path& path, int saves, unsigned spins) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    close(ends[0]);
    save_for_ever(path, ends[1]);
  }
  close(ends[1]);
  char byte = 0;
  for (int i = 0; i < saves; ++i) {
    ASSERT_EQ(read(ends[0], &byte, 1), 1);
  }
  for (volatile unsigned i = 0; i < spins;) {
    i = i + 1;
  }
  kill(child, SIGKILL);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status)) << "the child ended by itself: " << status;
  close(ends[0]);
}

// Seed 3, 100 kills.
TEST(DeviceSettingsFile, IsOneOfTheTwoWhenTheProcessIsKilledWhileItSaves) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "settings.yaml";
  save_settings(path, usual(), ids);
  std::mt19937 random(3);
  std::array<int, 2> seen{};
  for (int i = 0; i < 100; ++i) {
    kill_while_saving(path, 1 + int(random() % 4), unsigned(random() % 100'000));
    const DeviceSettings settings = load_settings(path, ids);
    EXPECT_TRUE(settings == usual() || settings == awkward());
    ++seen[settings == awkward() ? 1 : 0];
  }
  EXPECT_GT(seen[0], 0);
  EXPECT_GT(seen[1], 0);
}

}  // namespace
}  // namespace gonio
