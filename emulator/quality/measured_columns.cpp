#include "emulator/quality/measured_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace gonio {

namespace {

class Header {
 public:
  Header(const std::vector<DelimitedCell>& cells, const std::string& file)
      : cells_(cells), file_(file) {
    while (!cells_.empty() && cells_.back().text.empty()) {
      cells_.pop_back();  // after a delimiter at the end of the line
    }
  }

  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const DelimitedCell& cell : cells_) {
      names.push_back(cell.text);
    }
    return names;
  }

  /// @throws InputError  if the name is there twice.
  [[nodiscard]] std::optional<std::size_t> find(const std::string& name) const {
    const auto first = std::ranges::find(cells_, name, &DelimitedCell::text);
    if (first == cells_.end()) {
      return std::nullopt;
    }
    const auto second = std::find_if(first + 1, cells_.end(),
                                     [&](const DelimitedCell& cell) { return cell.text == name; });
    if (second != cells_.end()) {
      throw InputError({.file = file_, .line = second->line, .column = second->column},
                       fmt::format("one column '{}'", name), "a second one");
    }
    return std::size_t(first - cells_.begin());
  }

  /// @param purpose  e.g. "for the channel 60".
  [[nodiscard]] std::size_t require(const std::string& name, const std::string& purpose) const {
    if (const auto column = find(name)) {
      return *column;
    }
    throw InputError({.file = file_, .line = cells_.front().line, .column = cells_.front().column},
                     fmt::format("a column '{}' {}", name, purpose),
                     fmt::format("only {}", fmt::join(names(), ", ")));
  }

 private:
  std::vector<DelimitedCell> cells_;
  const std::string& file_;
};

void find_roles(const Header& header, const MeasuredFormat& format, bool by_own_names,
                MeasuredColumns& columns) {
  for (std::size_t i = 0; i < measured_role_count; ++i) {
    const std::string name = measured_role_names[i];
    if (by_own_names) {
      columns.roles[i] = header.find(name);
    } else if (const auto stated = format.roles.find(name); stated != format.roles.end()) {
      columns.roles[i] = header.require(stated->second, fmt::format("for the {}", name));
    }
  }
}

void find_channels(const Header& header, const MeasuredFormat& format, const Batch& batch,
                   MeasuredColumns& columns) {
  for (std::uint32_t c = 0; c < batch.channels.size(); ++c) {
    const BatchChannel& channel = batch.channels[c];
    if (channel.kind == BatchChannel::Kind::haze) {
      continue;
    }
    const auto stated = format.channels.find(channel.id);
    columns.channels.push_back(
        {.channel = c,
         .column = header.require(stated == format.channels.end() ? channel.id : stated->second,
                                  fmt::format("for the channel {}", channel.id))});
  }
}

}  // namespace

MeasuredColumns find_columns(const std::vector<DelimitedCell>& cells, const Batch& batch,
                             const std::string& file) {
  const Header header(cells, file);
  const MeasuredFormat format = batch.measured.value_or(MeasuredFormat{});
  MeasuredColumns columns{.names = header.names()};
  find_roles(header, format, format.roles.empty() && format.channels.empty(), columns);
  const bool has_channel = columns.of(MeasuredRole::channel).has_value();
  if (has_channel) {
    if (!columns.of(MeasuredRole::value)) {
      (void)header.require("value", "beside the column 'channel'");
    }
  } else {
    columns.roles[std::size_t(MeasuredRole::value)].reset();  // of something else
    find_channels(header, format, batch, columns);
  }
  if (format.skip) {
    columns.skip = header.require(format.skip->column, "that tells which rows to skip");
  }
  return columns;
}

}  // namespace gonio
