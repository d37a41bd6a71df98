#include "emulator/instrument/behaviour.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <limits>

namespace gonio {

namespace {

constexpr double ten_years_s = 3.2e8;
constexpr double largest_gu = 10'000.0;
constexpr std::size_t longest_text = 100;

/// Text that any display shows: printable ASCII.
std::string display_text(const YamlNode& node) {
  std::string text = node.line();
  const bool is_printable =
      std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
  if (!is_printable || text.size() > longest_text) {
    node.fail(fmt::format("at most {} printable ASCII characters", longest_text));
  }
  return text;
}

/// @return  the number of `digits` digits, or -1.
int digits_at(const std::string& text, std::size_t first, std::size_t digits) {
  int value = -1;
  const char* end = text.data() + first + digits;
  const auto read = std::from_chars(text.data() + first, end, value);
  return read.ptr == end && value >= 0 ? value : -1;
}

std::string date(const YamlNode& node) {
  std::string text = node.is_scalar() ? node.text() : std::string();
  const bool has_form = text.size() == 10 && text[4] == '-' && text[7] == '-';
  if (has_form) {
    const int year = digits_at(text, 0, 4);
    const int month = digits_at(text, 5, 2);
    const int day = digits_at(text, 8, 2);
    if (year >= 0 && month >= 0 && day >= 0 &&
        std::chrono::year_month_day(std::chrono::year(year), std::chrono::month(unsigned(month)),
                                    std::chrono::day(unsigned(day)))
            .ok()) {
      return text;
    }
  }
  node.fail("a date YYYY-MM-DD");
}

/// Calls `read` with the value of a key, if the key is there.
template <class Read>
void if_stated(YamlMap& map, const std::string& key, Read&& read) {
  if (const auto node = map.optional(key)) {
    read(*node);
  }
}

/// Reads a map into `behaviour`; all that `read` does not ask for is an error.
template <class Read>
void read_part(YamlMap& map, const std::string& key, Read&& read) {
  if_stated(map, key, [&](const YamlNode& node) {
    node.read_map([&](YamlMap& part) {
      read(part);
      return true;
    });
  });
}

void read_warm_up(YamlMap& map, Behaviour& behaviour) {
  behaviour.warm_up_s = map.required("time").time_s({.low = 0.0, .high = 86'400.0});
  if_stated(map, "loss", [&](const YamlNode& node) {
    behaviour.warm_up_loss = node.number({.low = 0.0, .high = 1.0, .high_open = true});
  });
}

void read_lamp_drift(YamlMap& map, Behaviour& behaviour) {
  behaviour.drift_per_h = map.required("per_hour").number(Range::closed(0.0, 1.0));
  behaviour.drift_limit =
      map.required("limit").number({.low = 0.0, .high = 1.0, .low_open = true, .high_open = true});
}

void read_temperature(YamlMap& map, Behaviour& behaviour) {
  if_stated(map, "ambient", [&](const YamlNode& node) {
    behaviour.ambient_c = node.temperature_c(Range::closed(-20.0, 60.0));
  });
  if_stated(map, "self_heating", [&](const YamlNode& node) {
    behaviour.self_heating_k = node.temperature_difference_k(Range::closed(0.0, 40.0));
  });
  if_stated(map, "signal_per_kelvin", [&](const YamlNode& node) {
    behaviour.signal_per_k = node.number(Range::closed(-0.01, 0.01));
  });
}

void read_tile(YamlMap& map, Behaviour& behaviour) {
  if_stated(map, "refractive_index", [&](const YamlNode& node) {
    behaviour.tile_index = node.number({.low = 1.0, .high = 5.0, .low_open = true});
  });
  if_stated(map, "contamination", [&](const YamlNode& node) {
    behaviour.tile_contamination = node.number(Range::closed(0.0, 1.0));
  });
  if_stated(map, "limit", [&](const YamlNode& node) {
    behaviour.tile_limit_gu = node.gloss_gu({.low = 0.0, .high = 100.0, .low_open = true});
  });
}

void read_calibration(YamlMap& map, Behaviour& behaviour) {
  if_stated(map, "time", [&](const YamlNode& node) {
    behaviour.calibration_s = node.time_s(Range::closed(0.0, 3600.0));
  });
  if_stated(map, "interval", [&](const YamlNode& node) {
    behaviour.calibration_interval_s =
        node.time_s({.low = 0.0, .high = ten_years_s, .low_open = true});
  });
  if_stated(map, "required",
            [&](const YamlNode& node) { behaviour.calibration_required = node.boolean(); });
}

/// All channels have a full scale, or none has.
std::vector<double> read_full_scale(const YamlNode& node,
                                    const std::vector<std::string>& geometry_ids,
                                    std::vector<double> full_scale_gu) {
  const bool is_first = full_scale_gu.empty();
  full_scale_gu.resize(geometry_ids.size());
  return node.read_map([&](YamlMap& map) {
    for (std::size_t i = 0; i < geometry_ids.size(); ++i) {
      const auto stated =
          is_first ? std::optional(map.required(geometry_ids[i])) : map.optional(geometry_ids[i]);
      if (stated) {
        full_scale_gu[i] = stated->gloss_gu({.low = 0.0, .high = largest_gu, .low_open = true});
      }
    }
    return full_scale_gu;
  });
}

void read_optics(YamlMap& map, Behaviour& behaviour) {
  if_stated(map, "resolution", [&](const YamlNode& node) {
    behaviour.resolution_gu = node.gloss_gu(Range::closed(0.0, 100.0));
  });
  if_stated(map, "stray_light", [&](const YamlNode& node) {
    behaviour.stray_light_gu = node.gloss_gu(Range::closed(0.0, 1000.0));
  });
  if_stated(map, "ambient_light", [&](const YamlNode& node) {
    behaviour.ambient_light_gu = node.gloss_gu(Range::closed(0.0, 1000.0));
  });
  if_stated(map, "linearity", [&](const YamlNode& node) {
    behaviour.linearity = node.number(Range::closed(-0.1, 0.1));
    if (behaviour.full_scale_gu.empty()) {
      node.fail("the key 'full_scale' beside it", "none");
    }
  });
}

}  // namespace

std::optional<InstrumentFault> instrument_fault(const std::string& name) {
  const auto found = std::find(instrument_fault_names.begin(), instrument_fault_names.end(), name);
  if (found == instrument_fault_names.end()) {
    return std::nullopt;
  }
  return InstrumentFault(found - instrument_fault_names.begin());
}

std::optional<Range> magnitude_range(InstrumentFault fault) {
  switch (fault) {
    case InstrumentFault::drift_step:
      return Range::closed(-1.0, 10.0);
    case InstrumentFault::tile_dirty:
      return Range::closed(0.0, 1.0);
    default:
      return std::nullopt;
  }
}

Behaviour Behaviour::ideal() const {
  Behaviour same;
  same.warm_up_s = 0.0;
  same.reading_s = 0.0;
  same.calibration_s = 0.0;
  same.ambient_c = ambient_c;
  same.self_heating_k = self_heating_k;
  same.tile_limit_gu = tile_limit_gu;
  same.calibration_interval_s = calibration_interval_s;
  same.calibration_required = false;
  same.tile_index = tile_index;
  same.seed = seed;
  return same;
}

Identity read_identity(const YamlNode& node) {
  return node.read_map([](YamlMap& map) {
    Identity identity;
    const auto read = [&](const std::string& key, std::string& text) {
      if_stated(map, key, [&](const YamlNode& value) { text = display_text(value); });
    };
    read("manufacturer", identity.manufacturer);
    read("model", identity.model);
    read("serial_number", identity.serial_number);
    read("url", identity.url);
    read("calibration_text", identity.calibration_text);
    if_stated(map, "calibration_date",
              [&](const YamlNode& value) { identity.calibration_date = date(value); });
    return identity;
  });
}

TimedFault read_timed_fault(const YamlNode& node) {
  return node.read_map([&](YamlMap& map) {
    const YamlNode name = map.required("fault");
    const auto fault = instrument_fault(
        name.choice({instrument_fault_names.begin(), instrument_fault_names.end()}));
    TimedFault timed{.fault = *fault};
    timed.after_s = map.required("after").time_s(Range::closed(0.0, ten_years_s));
    if (const auto range = magnitude_range(timed.fault)) {
      timed.magnitude = map.required("magnitude").number(*range);
    }
    return timed;
  });
}

Behaviour read_behaviour(const YamlNode& node, const std::vector<std::string>& geometry_ids,
                         Behaviour behaviour) {
  return node.read_map([&](YamlMap& map) {
    if_stated(map, "full_scale", [&](const YamlNode& value) {
      behaviour.full_scale_gu = read_full_scale(value, geometry_ids, behaviour.full_scale_gu);
    });
    read_optics(map, behaviour);
    if_stated(map, "reading_time", [&](const YamlNode& value) {
      behaviour.reading_s = value.time_s(Range::closed(0.0, 3600.0));
    });
    const auto part = [&](const std::string& key, void (*read)(YamlMap&, Behaviour&)) {
      read_part(map, key, [&](YamlMap& below) { read(below, behaviour); });
    };
    part("warm_up", read_warm_up);
    part("lamp_drift", read_lamp_drift);
    part("temperature", read_temperature);
    part("tile", read_tile);
    part("calibration", read_calibration);
    if_stated(map, "seed", [&](const YamlNode& value) {
      behaviour.seed = std::uint64_t(value.integer(0, std::numeric_limits<int>::max()));
    });
    if_stated(map, "faults", [&](const YamlNode& value) {
      behaviour.faults.clear();
      for (const YamlNode& fault : value.list()) {
        behaviour.faults.push_back(read_timed_fault(fault));
      }
    });
    return behaviour;
  });
}

double displayed(double value, double resolution) {
  if (resolution <= 0.0) {
    return value;
  }
  const double steps = std::round(value / resolution);
  // Tenths of a step that is no binary fraction: 519 / 10 is 51.9, 519 * 0.1 is not.
  const double per_unit = std::round(1.0 / resolution);
  const bool divides = per_unit >= 1.0 && std::abs(per_unit * resolution - 1.0) < 1e-12;
  // The zero that is added turns a rounded -0 into 0.
  return (divides ? steps / per_unit : steps * resolution) + 0.0;
}

}  // namespace gonio
