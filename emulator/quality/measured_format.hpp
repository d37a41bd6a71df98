#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "emulator/core/input_error.hpp"
#include "emulator/core/yaml_map.hpp"

namespace gonio {

struct Batch;

/// What a column of a file of measured readings says of a reading besides its value.
enum class MeasuredRole { lot, panel, position, repetition, instrument, operator_, channel, value };
constexpr std::size_t measured_role_count = 8;
/// As input files call them, in the order of MeasuredRole.
inline constexpr std::array<const char*, measured_role_count> measured_role_names{
    "lot", "panel", "position", "repetition", "instrument", "operator", "channel", "value"};

/// How a file of measured readings is read: the map `readings` of a batch file.
///
///     readings:
///       delimiter: tab                # tab, comma, semicolon; found from the header if not stated
///       decimal: comma                # comma or point; point if not stated
///       columns: {panel: No, "60": Out}  # a role or a channel, and the header of its column
///       skip_rows_where: {column: Type, is: "Average"}   # rows that are no readings
struct MeasuredFormat {
  std::optional<char> delimiter = {};
  char decimal = '.';
  /// Header of the column of each role, by its name. What is not there: all readings are of lot 1,
  /// each row a panel of its own, positions in the order of rows, repetition 1, the first
  /// instrument, the first operator.
  std::map<std::string, std::string> roles = {};
  /// Header of the column of each channel, by its id. If roles has `channel` and `value` instead,
  /// each row is one reading: the first names the channel, the second the value. If there are
  /// neither roles nor channels, columns are called as the roles and channels are.
  std::map<std::string, std::string> channels = {};
  struct Skip {
    std::string column, is;
  };
  std::optional<Skip> skip = {};
  SourceMark mark = {};
};

/// @throws InputError  for anything that is not as above.
[[nodiscard]] MeasuredFormat read_measured_format(const YamlNode& node);

/// @param node  that was read as batch.measured.
/// @throws InputError  for a column of a channel that the batch does not read, and for a channel
///                     without a column.
void expect_channels_of(const Batch& batch, const YamlNode& node);

}  // namespace gonio
