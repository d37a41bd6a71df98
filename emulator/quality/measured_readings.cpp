#include "emulator/quality/measured_readings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <utility>

#include "emulator/core/quantity.hpp"
#include "emulator/quality/measured_columns.hpp"
#include "emulator/quality/measured_panel.hpp"
#include "emulator/quality/measured_text.hpp"

namespace gonio {

namespace {

constexpr std::size_t most_rows = 10'000'000;
constexpr double most_positions = 1e6;  // and repetitions

/// Reads the rows of a file.
class MeasuredReader {
 public:
  MeasuredReader(std::string file, const Batch& batch)
      : file_(std::move(file)),
        batch_(batch),
        decimal_(batch.measured ? batch.measured->decimal : '.') {}

  void row(const std::vector<DelimitedCell>& cells) {
    if (columns_.names.empty()) {
      columns_ = find_columns(cells, batch_, file_);
      return;
    }
    expect_count(cells);
    if (++rows_ > most_rows) {
      fail(cells.front(), {}, fmt::format("at most {} rows", most_rows), "more");
    }
    if (columns_.skip && cells[*columns_.skip].text == batch_.measured->skip->is) {
      return;
    }
    take(cells);
  }

  std::vector<PanelRecord> finish() {
    if (panels_.empty()) {
      throw InputError({.file = file_}, rows_ == 0 ? "rows of readings" : "rows that are readings",
                       "none");
    }
    for (MeasuredPanel& panel : panels_) {
      close(panel);
    }
    return lot_by_lot();
  }

 private:
  [[noreturn]] void fail(const DelimitedCell& cell, const std::string& key,
                         const std::string& expected, const std::string& found) const {
    throw InputError({.file = file_, .line = cell.line, .column = cell.column, .key = key},
                     expected, found);
  }

  /// Of a cell in the column of that name, with its own text.
  [[noreturn]] void fail(const std::vector<DelimitedCell>& cells, std::size_t column,
                         const std::string& expected) const {
    const std::string& text = cells[column].text;
    fail(cells[column], columns_.names[column], expected, text.empty() ? "nothing" : text);
  }

  void expect_count(const std::vector<DelimitedCell>& cells) const {
    const std::size_t expected = columns_.names.size();
    const auto beyond = cells.begin() + std::ptrdiff_t(std::min(expected, cells.size()));
    const auto extra = std::find_if(beyond, cells.end(),
                                    [](const DelimitedCell& cell) { return !cell.text.empty(); });
    if (cells.size() < expected || extra != cells.end()) {
      fail(extra == cells.end() ? cells.back() : *extra, {}, fmt::format("{} cells", expected),
           fmt::format("{} cells", cells.size()));
    }
  }

  double number_in(const std::vector<DelimitedCell>& cells, std::size_t column) const {
    std::string text = cells[column].text;
    const bool has_comma = decimal_ == ',';
    const bool is_mixed = text.find(has_comma ? '.' : ',') != std::string::npos;
    if (const std::size_t comma = text.find(','); comma != std::string::npos) {
      text[comma] = '.';
    }
    const auto value = is_mixed ? std::nullopt : parse_quantity(text, Dimension::number);
    if (!value) {
      fail(cells, column,
           fmt::format("a number with a decimal {} and no thousands separators",
                       has_comma ? "comma" : "point"));
    }
    return *value;
  }

  std::uint32_t count_in(const std::vector<DelimitedCell>& cells, MeasuredRole role) const {
    const auto column = columns_.of(role);
    if (!column) {
      return 1;
    }
    const auto value = parse_quantity(cells[*column].text, Dimension::number);
    if (!value || *value < 1.0 || *value > most_positions || *value != double(int(*value))) {
      fail(cells, *column, fmt::format("a whole number in [1, {:.0f}]", most_positions));
    }
    return std::uint32_t(*value);
  }

  /// The place of what a cell names, among what there is; 0 without such a column.
  template <class Things, class Id>
  std::uint32_t place_in(const std::vector<DelimitedCell>& cells, MeasuredRole role,
                         const Things& things, Id id, const char* noun) const {
    const auto column = columns_.of(role);
    if (!column) {
      return 0;
    }
    const auto found = std::ranges::find(things, cells[*column].text, id);
    if (found == things.end()) {
      std::vector<std::string> ids;
      std::ranges::transform(things, std::back_inserter(ids), id);
      fail(cells, *column, fmt::format("one of the {} {}", noun, fmt::join(ids, ", ")));
    }
    return std::uint32_t(found - things.begin());
  }

  /// The number, from 1, of what a cell names: numbers are given as names first come.
  std::uint64_t number_of(const std::vector<DelimitedCell>& cells, MeasuredRole role,
                          std::unordered_map<std::string, std::uint64_t>& known) const {
    const std::size_t column = columns_.of(role).value();
    if (cells[column].text.empty()) {
      fail(cells, column, fmt::format("the name of a {}", measured_role_names[std::size_t(role)]));
    }
    return known.try_emplace(cells[column].text, known.size() + 1).first->second;
  }

  MeasuredPanel& panel_of(const std::vector<DelimitedCell>& cells) {
    const auto column = columns_.of(MeasuredRole::panel);
    const std::uint64_t number =
        column ? number_of(cells, MeasuredRole::panel, panel_numbers_) : panels_.size() + 1;
    const auto lot_column = columns_.of(MeasuredRole::lot);
    const std::uint64_t lot = lot_column ? number_of(cells, MeasuredRole::lot, lot_numbers_) : 1;
    if (number > panels_.size()) {
      panels_.push_back(
          {.record = {.lot = lot, .label = column ? cells[*column].text : std::string()}});
    }
    MeasuredPanel& panel = panels_[number - 1];
    if (panel.record.lot != lot) {
      fail(cells, *lot_column,
           fmt::format("the lot of the first row of panel {} (panels of two lots need two names)",
                       panel.record.label));
    }
    return panel;
  }

  void take(const std::vector<DelimitedCell>& cells) {
    MeasuredPanel& panel = panel_of(cells);
    ReadingRecord reading{
        .position = count_in(cells, MeasuredRole::position),
        .repetition = count_in(cells, MeasuredRole::repetition),
        .instrument = place_in(cells, MeasuredRole::instrument, batch_.instruments, &Instrument::id,
                               "instruments"),
        .operator_ = place_in(cells, MeasuredRole::operator_, batch_.operators,
                              &OperatorStatement::id, "operators")};
    const auto add = [&](std::uint32_t channel, std::size_t column) {
      reading.channel = channel;
      reading.value = number_in(cells, column);
      panel.record.readings.push_back(reading);
      panel.places.push_back({.line = cells[column].line, .column = cells[column].column});
    };
    if (const auto value = columns_.of(MeasuredRole::value)) {
      add(channel_in(cells), *value);
      return;
    }
    for (const MeasuredColumns::OfChannel& channel : columns_.channels) {
      add(channel.channel, channel.column);
    }
  }

  std::uint32_t channel_in(const std::vector<DelimitedCell>& cells) const {
    const std::uint32_t channel =
        place_in(cells, MeasuredRole::channel, batch_.channels, &BatchChannel::id, "channels");
    if (batch_.channels[channel].kind == BatchChannel::Kind::haze) {
      fail(cells, *columns_.of(MeasuredRole::channel),
           "a channel with readings of its own; haze follows from those of gloss");
    }
    return channel;
  }

  void close(MeasuredPanel& panel) const {
    if (columns_.of(MeasuredRole::position)) {
      panel.expect_no_doubles(batch_, file_);
    } else {
      panel.number_positions();
    }
    panel.expect_all_channels(batch_, file_);
  }

  std::vector<PanelRecord> lot_by_lot() {
    std::stable_sort(
        panels_.begin(), panels_.end(),
        [](const MeasuredPanel& a, const MeasuredPanel& b) { return a.record.lot < b.record.lot; });
    std::vector<PanelRecord> records;
    records.reserve(panels_.size());
    for (MeasuredPanel& panel : panels_) {
      panel.record.number = records.size() + 1;
      records.push_back(std::move(panel.record));
    }
    return records;
  }

  std::string file_;
  const Batch& batch_;
  char decimal_;
  MeasuredColumns columns_ = {};
  std::size_t rows_ = 0;
  std::unordered_map<std::string, std::uint64_t> panel_numbers_ = {}, lot_numbers_ = {};
  std::vector<MeasuredPanel> panels_ = {};
};

}  // namespace

std::vector<PanelRecord> load_measured_readings(const std::filesystem::path& file,
                                                const Batch& batch) {
  const std::string text = read_measured_text(file);
  const bool is_stated = batch.measured && batch.measured->delimiter;
  MeasuredReader reader(file.string(), batch);
  for_each_delimited_row(text, is_stated ? *batch.measured->delimiter : delimiter_of(text),
                         file.string(),
                         [&](const std::vector<DelimitedCell>& cells) { reader.row(cells); });
  return reader.finish();
}

}  // namespace gonio
