#include "emulator/quality/measured_format.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "emulator/quality/batch.hpp"
#include "emulator/quality/batch_specification.hpp"

namespace gonio {

namespace {

bool is_role(const std::string& name) {
  return std::ranges::find(measured_role_names, name) != measured_role_names.end();
}

bool has_role(const MeasuredFormat& format, MeasuredRole role) {
  return format.roles.contains(measured_role_names[std::size_t(role)]);
}

char read_delimiter(const YamlNode& node) {
  const std::string name = node.choice({"tab", "comma", "semicolon"});
  return name == "tab" ? '\t' : name == "comma" ? ',' : ';';
}

void read_columns(const YamlNode& node, MeasuredFormat& format) {
  node.for_each_entry([&](const std::string& key, const YamlNode& value) {
    auto& columns = is_role(key) ? format.roles : format.channels;
    if (!columns.emplace(geometry_of(key), value.line()).second) {
      value.fail("each channel once", fmt::format("{} a second time", geometry_of(key)));
    }
  });
  const bool has_channel = has_role(format, MeasuredRole::channel);
  if (has_channel != has_role(format, MeasuredRole::value)) {
    node.fail("both of the columns channel and value", has_channel ? "only channel" : "only value");
  }
  if (has_channel && !format.channels.empty()) {
    node.fail("a column for each channel, or the columns channel and value", "both");
  }
  if (!has_channel && format.channels.empty()) {
    node.fail("a column for each channel, or the columns channel and value", "neither");
  }
}

/// Ids of the channels that have readings.
std::vector<std::string> channels_read(const Batch& batch) {
  std::vector<std::string> ids;
  for (const BatchChannel& channel : batch.channels) {
    if (channel.kind != BatchChannel::Kind::haze) {
      ids.push_back(channel.id);
    }
  }
  return ids;
}

}  // namespace

MeasuredFormat read_measured_format(const YamlNode& node) {
  return node.read_map([&](YamlMap& map) {
    MeasuredFormat format{.mark = node.mark()};
    if (const auto delimiter = map.optional("delimiter")) {
      format.delimiter = read_delimiter(*delimiter);
    }
    if (const auto decimal = map.optional("decimal")) {
      format.decimal = decimal->choice({"comma", "point"}) == "comma" ? ',' : '.';
    }
    if (const auto columns = map.optional("columns")) {
      read_columns(*columns, format);
    }
    if (const auto skip = map.optional("skip_rows_where")) {
      format.skip = skip->read_map([](YamlMap& inner) {
        return MeasuredFormat::Skip{.column = inner.required("column").line(),
                                    .is = inner.required("is").line()};
      });
    }
    return format;
  });
}

void expect_channels_of(const Batch& batch, const YamlNode& node) {
  if (!batch.measured || batch.measured->channels.empty()) {
    return;
  }
  const std::vector<std::string> known = channels_read(batch);
  YamlMap map(node);
  const YamlNode columns = map.required("columns");
  columns.for_each_entry([&](const std::string& key, const YamlNode& value) {
    if (!is_role(key) && std::ranges::find(known, geometry_of(key)) == known.end()) {
      value.fail(fmt::format("a column of a role ({}), or of a channel ({})",
                             fmt::join(measured_role_names, ", "), fmt::join(known, ", ")),
                 key);
    }
  });
  for (const std::string& id : known) {
    if (!batch.measured->channels.contains(id)) {
      columns.fail(fmt::format("a column for the channel {}, which the batch reads", id), "none");
    }
  }
}

}  // namespace gonio
