#include "reports/chart.hpp"

#include <fmt/format.h>

#include <cmath>
#include <regex>

#include "reports/gnuplot.hpp"
#include "reports/templates.hpp"

namespace gonio {

namespace {

std::string row_text(const std::vector<double>& row) {
  std::string text;
  for (const double value : row) {
    text += std::isfinite(value) ? fmt::format("{:.9g} ", value) : "NaN ";
  }
  return text + "\n";
}

/// A part of a page: without what makes it a file of its own, and without a size of its own, so
/// that it takes the width it is given. A name that gnuplot gives to a curve says nothing.
std::string as_part_of_page(std::string svg, std::size_t number) {
  const auto begin = svg.find("<svg");
  svg.erase(0, begin == std::string::npos ? svg.size() : begin);
  const std::string prefix = fmt::format("chart{}_", number);
  svg = std::regex_replace(svg, std::regex(R"(<title>[^<]*</title>|<desc>[^<]*</desc>)"), "");
  svg = std::regex_replace(svg, std::regex(R"((<svg\s+)width="\d+" height="\d+")"), "$1");
  svg = std::regex_replace(svg, std::regex(R"(\bid=(["']))"), "id=$1" + prefix);
  return std::regex_replace(svg, std::regex(R"(((xlink:)?href=["']|url\()#)"), "$1#" + prefix);
}

}  // namespace

Chart& Chart::set(FixedName variable, double value) {
  numbers_ += fmt::format("{} = {}", variable.text(), row_text({value}));
  return *this;
}

Chart& Chart::block(FixedName data, const std::vector<Rows>& groups) {
  numbers_ += fmt::format("${} << END_OF_NUMBERS\n", data.text());
  for (const Rows& rows : groups) {
    for (const std::vector<double>& row : rows) {
      numbers_ += row_text(row);
    }
    numbers_ += "\n\n";
  }
  numbers_ += "END_OF_NUMBERS\n";
  return *this;
}

std::string Chart::script() const {
  return fmt::format("{}{}{}", numbers_, template_text("chart_style.gnuplot"),
                     template_text(fmt::format("{}.gnuplot", name_.text())));
}

std::string Chart::svg(std::size_t number) const {
  return as_part_of_page(run_gnuplot(script()), number);
}

}  // namespace gonio
