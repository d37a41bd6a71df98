#include "emulator/measured/astm_brdf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <optional>
#include <ostream>
#include <sstream>
#include <utility>

#include "emulator/core/input_error.hpp"
#include "emulator/core/text_file.hpp"
#include "emulator/measured/text_brdf.hpp"

namespace gonio {

namespace {

using Eigen::Index;
using std::numbers::pi;

enum class Column { theta_i, phi_i, theta_s, phi_s };
constexpr std::array<std::string_view, 4> column_names{"theta_i", "phi_i", "theta_s", "phi_s"};

std::string_view trimmed(std::string_view text) {
  constexpr const char* blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string_view::npos
             ? std::string_view()
             : text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

bool is_same_word(std::string_view a, std::string_view b) { return Word{.text = a}.is(b); }

/// Reads an ASTM text line by line.
class AstmReader {
 public:
  AstmReader(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  BrdfSamples read() {
    read_header();
    read_points();
    return std::move(samples_);
  }

 private:
  /// Sets line_ to the next one that is not blank; false at the end.
  bool next_line() {
    while (place_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', place_), text_.size());
      line_ = text_.substr(place_, end - place_);
      place_ = end + 1;
      ++number_;
      if (!trimmed(line_).empty()) {
        return true;
      }
    }
    line_ = {};
    return false;
  }

  [[noreturn]] void fail(std::string_view at, const std::string& expected,
                         const std::string& key = {}) const {
    const bool is_at_end = at.data() == nullptr;
    throw InputError({.file = file_,
                      .line = is_at_end ? number_ + 1 : number_,
                      .column = is_at_end ? 1 : int(at.data() - line_.data()) + 1,
                      .key = key},
                     expected, is_at_end ? "the end of the file" : std::string(at));
  }

  void read_header() {
    while (next_line()) {
      const std::string_view line = trimmed(line_);
      const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
      const std::string_view key = line.substr(0, end), value = trimmed(line.substr(end));
      if (key == "VARS") {
        read_columns(value.empty() ? line : value);
        return;
      }
      if (key == "NUM_POINTS") {
        read_number_of_points(value.empty() ? line : value);
      } else if (key[0] != '#') {
        keep_note(key, value);
      }
    }
    fail({}, "a line VARS with the names of columns");
  }

  void read_number_of_points(std::string_view value) {
    const auto number = number_of(value);
    if (number_of_points_) {
      fail(line_, "NUM_POINTS once");
    }
    if (!number || *number < 1.0 || *number != std::floor(*number)) {
      fail(value, "a whole number of at least 1", "NUM_POINTS");
    }
    number_of_points_ = *number;
  }

  void keep_note(std::string_view key, std::string_view value) {
    const auto is_of_key = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
    if (!std::ranges::all_of(key, is_of_key) || number_of(key)) {
      fail(key, "a line of a key and a value, NUM_POINTS or VARS");
    }
    if (value.size() >= 2 && value.front() == '"' && value.back() == '"') {
      value = value.substr(1, value.size() - 2);
    }
    if (!samples_.notes.emplace(key, value).second) {
      fail(key, "each key once");
    }
  }

  void read_columns(std::string_view names) {
    for (std::size_t begin = 0; begin <= names.size();) {
      const std::size_t end = std::min(names.find(',', begin), names.size());
      name_column(trimmed(names.substr(begin, end - begin)), names.substr(begin));
      begin = end + 1;
    }
    for (const Column needed : {Column::theta_i, Column::theta_s}) {
      if (std::ranges::find(columns_, std::optional(needed)) == columns_.end()) {
        fail(names, fmt::format("a column {}", column_names[std::size_t(needed)]), "VARS");
      }
    }
    if (samples_.channels.empty()) {
      fail(names, "a column of f_r: R,G,B or X,Y,Z or wavelengths such as 550nm", "VARS");
    }
    check_channels(names);
  }

  void name_column(std::string_view name, std::string_view place) {
    const std::string_view at = name.empty() ? place : name;
    std::optional<Column> column;
    for (std::size_t i = 0; i < column_names.size(); ++i) {
      if (is_same_word(name, column_names[i])) {
        column = Column(i);
      }
    }
    if (is_same_word(name, "theta_r")) {
      column = Column::theta_s;
    } else if (is_same_word(name, "phi_r")) {
      column = Column::phi_s;
    }
    if (column && std::ranges::find(columns_, column) != columns_.end()) {
      fail(at, "each column once", "VARS");
    }
    columns_.push_back(column);
    if (!column) {
      name_channel(name, at);
    }
  }

  void name_channel(std::string_view name, std::string_view at) {
    const auto channel = channel_named(name);
    if (name.empty() || (!channel && !samples_.channels.empty()) || has_unnamed_channel_) {
      fail(at, "R,G,B or X,Y,Z or wavelengths such as 550nm, or one f_r of any name", "VARS");
    }
    if (channel && std::ranges::find(samples_.channels, *channel) != samples_.channels.end()) {
      fail(at, "each column once", "VARS");
    }
    has_unnamed_channel_ = !channel;
    samples_.channels.push_back(channel.value_or(BrdfChannel{}));
  }

  void check_channels(std::string_view names) const {
    using Band = BrdfChannel::Band;
    const auto kind = [](const BrdfChannel& channel) {
      switch (channel.band) {
        case Band::wavelength:
        case Band::luminance:
          return channel.band;
        case Band::red:
        case Band::green:
        case Band::blue:
          return Band::red;
        default:
          return Band::x;
      }
    };
    const Band first = kind(samples_.channels.front());
    const bool is_one_kind = std::ranges::all_of(
        samples_.channels, [&](const BrdfChannel& channel) { return kind(channel) == first; });
    const bool is_whole =
        first == Band::wavelength || first == Band::luminance || samples_.channels.size() == 3;
    if (!is_one_kind || !is_whole) {
      fail(names, "channels of one kind: all of R,G,B or X,Y,Z, or wavelengths, or one luminance",
           "VARS");
    }
  }

  void read_points() {
    std::vector<double> values;
    Index n = 0;
    while (next_line()) {
      read_row(values);
      ++n;
    }
    if (n == 0) {
      fail({}, "a row of numbers");
    }
    if (number_of_points_ && *number_of_points_ != double(n)) {
      fail({},
           fmt::format("{:.0f} points, as NUM_POINTS says, rather than {}", *number_of_points_, n));
    }
    fill_samples(values, n);
  }

  void read_row(std::vector<double>& values) const {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const std::size_t end = std::min(line_.find(',', begin), line_.size());
      std::string_view cell = trimmed(line_.substr(std::min(begin, line_.size()), end - begin));
      if (cell.empty()) {
        cell = line_.substr(std::min(begin, line_.size() - 1), 1);
      }
      const auto value = number_of(cell);
      if (!value) {
        fail(cell, fmt::format("{} numbers between commas", columns_.size()));
      }
      check_angle(columns_[i], *value, cell);
      values.push_back(*value);
      const bool is_last = i + 1 == columns_.size();
      if (is_last ? end != line_.size() : end == line_.size()) {
        fail(is_last ? line_.substr(end, 1) : cell,
             fmt::format("{} numbers between commas", columns_.size()));
      }
      begin = end + 1;
    }
  }

  void check_angle(std::optional<Column> column, double value, std::string_view cell) const {
    constexpr double rounding = 1e-4;  // of files of few digits
    if (!column) {
      return;
    }
    const bool is_polar = *column == Column::theta_i || *column == Column::theta_s;
    const double largest = is_polar ? pi / 2.0 : 2.0 * pi;
    if (std::abs(value) > largest + rounding) {
      fail(cell, fmt::format("an angle in [-{0:.4f}, {0:.4f}] radians", largest),
           std::string(column_names[std::size_t(*column)]));
    }
  }

  void fill_samples(const std::vector<double>& values, Index n) {
    const auto n_columns = Index(columns_.size());
    const Eigen::Map<const Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>
        table(values.data(), n, n_columns);
    samples_.theta_i = samples_.theta_r = samples_.phi_r = Eigen::ArrayXd::Zero(n);
    samples_.phi_i = Eigen::ArrayXd::Constant(n, pi);
    samples_.f_r.resize(n, Index(samples_.channels.size()));
    const std::array<Eigen::ArrayXd*, 4> angles{&samples_.theta_i, &samples_.phi_i,
                                                &samples_.theta_r, &samples_.phi_r};
    bool has_phi_i = false, has_phi_s = false;
    for (Index i = 0, channel = 0; i < n_columns; ++i) {
      const auto& column = columns_[std::size_t(i)];
      if (column) {
        *angles[std::size_t(*column)] = table.col(i);
        has_phi_i = has_phi_i || column == Column::phi_i;
        has_phi_s = has_phi_s || column == Column::phi_s;
      } else {
        samples_.f_r.col(channel++) = table.col(i);
      }
    }
    if (has_phi_i && !has_phi_s) {
      samples_.phi_r = samples_.phi_i - pi;  // in the plane of incidence
    }
  }

  std::string_view text_;
  const std::string& file_;
  std::string_view line_ = {};
  std::size_t place_ = 0;
  int number_ = 0;
  std::optional<double> number_of_points_ = {};
  std::vector<std::optional<Column>> columns_ = {};  ///< nothing: a channel
  bool has_unnamed_channel_ = false;
  BrdfSamples samples_ = {};
};

/// A note as one line; in quotes if it would not be read back else.
std::string note_text(const std::string& note) {
  std::string text(trimmed(note));
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' '; }, ' ');
  const bool needs_quotes =
      text.empty() || text.front() == '"' || text.find(' ') != std::string::npos;
  return needs_quotes ? fmt::format("\"{}\"", text) : text;
}

}  // namespace

BrdfSamples read_astm(const std::filesystem::path& path) {
  return parse_astm(read_text_file(path, largest_brdf_text_mib), path.string());
}

BrdfSamples parse_astm(std::string_view text, const std::string& file) {
  return AstmReader(text, file).read();
}

void write_astm(const BrdfSamples& samples, std::ostream& out) {
  for (const auto& [key, note] : samples.notes) {
    out << key << ' ' << note_text(note) << '\n';
  }
  fmt::memory_buffer line;
  fmt::format_to(std::back_inserter(line), "NUM_POINTS {}\nVARS theta_i,phi_i,theta_s,phi_s",
                 samples.size());
  for (const BrdfChannel& channel : samples.channels) {
    fmt::format_to(std::back_inserter(line), ",{}", channel_name(channel));
  }
  for (Index i = 0; i < samples.size(); ++i) {
    fmt::format_to(std::back_inserter(line), "\n{},{},{},{}", samples.theta_i[i], samples.phi_i[i],
                   samples.theta_r[i], samples.phi_r[i]);
    for (const double value : samples.f_r.row(i)) {
      fmt::format_to(std::back_inserter(line), ",{}", value);
    }
    out.write(line.data(), std::streamsize(line.size()));
    line.clear();
  }
  line.push_back('\n');
  out.write(line.data(), std::streamsize(line.size()));
}

std::string astm_text(const BrdfSamples& samples) {
  std::ostringstream out;
  write_astm(samples, out);
  return out.str();
}

}  // namespace gonio
