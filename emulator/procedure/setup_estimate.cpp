#include "emulator/procedure/setup_estimate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "emulator/procedure/setup_estimator.hpp"

namespace gonio {

namespace {

/// The readings of one geometry, and each of their tiles once.
struct GeometryReadings {
  std::vector<TileReading> readings = {};
  std::vector<std::size_t> tile_of = {};
  std::vector<Sample> tiles = {};
};

GeometryReadings readings_of(const std::string& geometry_id,
                             const std::vector<TileReading>& readings,
                             const std::vector<Sample>& tiles) {
  GeometryReadings result;
  std::vector<std::string> names;  // of result.tiles
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (readings[i].geometry != geometry_id) {
      continue;
    }
    const auto found = std::ranges::find(names, readings[i].sample);
    result.readings.push_back(readings[i]);
    result.tile_of.push_back(std::size_t(found - names.begin()));
    if (found == names.end()) {
      names.push_back(readings[i].sample);
      result.tiles.push_back(tiles[i]);
    }
  }
  return result;
}

}  // namespace

std::vector<SetupEstimate> estimate_setup(const Instrument& instrument,
                                          const std::vector<TileReading>& readings,
                                          const std::vector<Sample>& tiles,
                                          const SetupEstimateOptions& options) {
  if (tiles.size() != readings.size()) {
    throw std::invalid_argument(
        fmt::format("estimate_setup: {} tiles of {} readings", tiles.size(), readings.size()));
  }
  for (const TileReading& reading : readings) {
    if (!instrument.has(reading.geometry)) {
      throw InputError(
          reading.geometry_mark,
          fmt::format("one of the geometries {}", fmt::join(instrument.geometries, ", ")),
          reading.geometry);
    }
  }
  std::vector<SetupEstimate> estimates;
  for (const std::string& geometry_id : instrument.geometries) {
    const GeometryReadings found = readings_of(geometry_id, readings, tiles);
    if (!found.readings.empty()) {
      estimates.push_back(SetupEstimator(instrument, geometry_id, found.tiles, options)
                              .estimate(found.readings, found.tile_of));
    }
  }
  return estimates;
}

}  // namespace gonio
