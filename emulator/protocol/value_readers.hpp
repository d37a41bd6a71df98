#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "emulator/protocol/instrument_values.hpp"

// What the tables of values are made of.

namespace gonio::value_readers {

using Values = std::map<std::string, InstrumentValue>;
using View = InstrumentView;

template <class Enum>
[[nodiscard]] double number_of(Enum value) {
  return static_cast<double>(static_cast<int>(value));
}

inline const Device::Status& status(const View& view) { return view.device.status(); }

/// A value of the whole instrument.
template <class Read>
InstrumentValue whole(Read read) {
  return {.number = [read](const View& view, std::size_t) { return double(read(view)); }};
}

template <class Read>
InstrumentValue text(Read read) {
  return {.text = [read](const View& view) { return std::string(read(view)); }};
}

/// A count of the server, which wraps.
template <class Read>
InstrumentValue counter(Read read) {
  return {
      .number = [read](const View& view, std::size_t) { return double(std::uint32_t(read(view))); },
      .is_counter = true};
}

/// Adds what the server and not the device knows: the simulation, its counters, who it is.
void add_server_values(Values& values);

}  // namespace gonio::value_readers
