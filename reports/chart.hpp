#pragma once

#include <string>
#include <string_view>
#include <vector>

// Charts are drawn by gnuplot, which runs commands that it finds between backticks. Hence no text
// of anyone's reaches it: a chart is a template that was compiled in, and numbers.

namespace gonio {

/// A name that stands in the source of gonio: from nothing else can it be made.
class FixedName {
 public:
  // NOLINTNEXTLINE(google-explicit-constructor): a literal is to be the name
  consteval FixedName(const char* text) : text_(text) {}
  [[nodiscard]] std::string_view text() const { return text_; }

 private:
  std::string_view text_;
};

using Rows = std::vector<std::vector<double>>;

/// The numbers of a chart, and the template that draws them.
class Chart {
 public:
  /// @param name  of a file <name>.gnuplot in reports/templates.
  explicit Chart(FixedName name) : name_(name) {}

  /// A variable of the template.
  Chart& set(FixedName variable, double value);
  /// A data block of the template, with its groups of rows in the order of `index`.
  /// A number that is not finite is a gap.
  Chart& block(FixedName data, const std::vector<Rows>& groups);

  /// What gnuplot is given: names of gonio's own, and numbers.
  [[nodiscard]] std::string script() const;
  /// The chart as one SVG element that may stand in a page beside others.
  /// @param number  of the chart in its page, for ids that no other chart has.
  /// @throws std::system_error  if gnuplot cannot be run, or fails.
  [[nodiscard]] std::string svg(std::size_t number) const;

 private:
  FixedName name_;
  std::string numbers_;
};

}  // namespace gonio
