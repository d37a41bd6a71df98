#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "emulator/protocol/client.hpp"
#include "emulator/protocol/register_map.hpp"

namespace gonio {

/// All points of blocks of the standard map. @throws std::out_of_range  for a block that is none.
[[nodiscard]] std::vector<const Point*> points_of_blocks(const std::vector<std::string>& ids);

/// A point as people name it: by its id, e.g. gloss_2, or by an angle of incidence, e.g. gloss_60.
struct PointName {
  const Point* point = nullptr;  ///< that of channel 1 if an angle is named
  std::optional<double> angle_deg = {};
  std::string text;

  /// @throws std::invalid_argument  for a name that no point has.
  [[nodiscard]] static PointName parse(const std::string& text);
  /// Asks the device for its angles if need be.
  /// @throws std::invalid_argument  for an angle that the device has not.
  [[nodiscard]] const Point& resolve(ModbusClient& client) const;
};

/// What a device showed of some points. All that fits in one request is of one moment, and as few
/// requests were made as possible: they bridge points that were not asked for, but no holes.
/// With a reading as float32 its state is read too, which alone tells missing from over range.
class DeviceView {
 public:
  /// Reads them. @param points  of the standard map, in any order. @throws as ModbusClient does.
  DeviceView(ModbusClient& client, const std::vector<const Point*>& points);

  [[nodiscard]] bool has(const std::string& id) const { return values_.contains(id); }
  /// NaN for what there is none of, infinity over range. A float32 has the shortest decimal that
  /// rounds to it. @throws std::out_of_range  for a point that was not read, or is text.
  [[nodiscard]] double number(const std::string& id) const;
  [[nodiscard]] bool bit(const std::string& id, const std::string& name) const;
  /// As people read it; for a text what it says. @see number_text()
  [[nodiscard]] std::string text(const std::string& id) const;
  /// What the number of a point with symbols means, in words.
  [[nodiscard]] std::string meaning(const std::string& id) const;
  /// The same for the bits that are on.
  [[nodiscard]] std::vector<std::string> meanings(const std::string& id) const;

 private:
  struct Value {
    const Point* point = nullptr;
    double number = 0.0;
    std::string text = {};
  };
  [[nodiscard]] const Value& value(const std::string& id) const;

  std::map<std::string, Value> values_;
};

}  // namespace gonio
