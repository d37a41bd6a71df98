#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emulator/core/catalog.hpp"
#include "emulator/protocol/station.hpp"

namespace gonio::app {

/// Which instruments are served, and how they behave.
struct StationOptions {
  std::vector<std::string> instruments;
  std::vector<int> units;
  std::vector<std::string> samples;
  std::string place = "nothing";
  bool is_ideal = false;
  std::optional<std::uint64_t> seed;
  double speed = 1.0;
  std::optional<std::string> state_folder;
  std::vector<std::string> faults;
  bool has_no_simulation = false;
};

void add_station_options(CLI::App& command, StationOptions& options);

/// Loads the instruments, computes what they read, and lays something on their ports.
/// @throws InputError, std::invalid_argument  for an option that is wrong.
[[nodiscard]] std::unique_ptr<Station> make_station(const StationOptions& options,
                                                    const Catalog& catalog);

}  // namespace gonio::app
