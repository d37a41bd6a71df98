#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "emulator/core/unit_value.hpp"
#include "reports/scan_report.hpp"
#include "reports/text_table.hpp"

namespace gonio {

namespace {

constexpr std::size_t piece = 1 << 16;  // bytes written at once

const char* state_words(PositionState state) {
  switch (state) {
    case PositionState::measured:
      return "measured";
    case PositionState::reciprocal:
      return "reciprocal";
    case PositionState::blocked:
      break;
  }
  return "blocked";
}

void add_cells(const Eigen::ArrayXd& values, std::string& row) {
  for (const double value : values) {
    if (std::isfinite(value)) {
      fmt::format_to(std::back_inserter(row), ",{}", value);
    } else {
      row += ',';
    }
  }
}

}  // namespace

std::string scan_text(const ScanReport& report, bool styled) {
  std::string text = fmt::format("{}", heading_text(report.sample_title, styled));
  text += fmt::format("{}\n", report.plan.title);
  TextTable facts({"", ""});
  for (const ScanFact& fact : scan_facts(report)) {
    facts.add({fact.what, fact.value});
  }
  text += facts.text();
  text += fmt::format("\n{}", table_text(scan_table(report), styled));
  return text;
}

void write_scan_csv(const ScanReport& report, const TextSink& write) {
  const ScanResult& result = report.result;
  std::string text;
  for (const ScanFact& fact : scan_facts(report)) {
    fmt::format_to(std::back_inserter(text), "# {}: {}\n", fact.what, fact.value);
  }
  text +=
      "# angles in deg, f_r in 1/sr, omega_r (projected) in sr, flux as a share of what falls on "
      "the sample at all wavelengths\n"
      "theta_i,rotation,theta_r,phi_r,state,omega_r,f_r,error";
  for (const char* quantity : {"f_r", "flux"}) {
    for (const double nanometre : report.plan.grid.nanometres()) {
      fmt::format_to(std::back_inserter(text), ",{}_{}", quantity, nanometre);
    }
  }
  text += '\n';
  for (Eigen::Index p = 0; p < result.size(); ++p) {
    const ScanPosition& at = result.positions[std::size_t(p)];
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{}", stated_degrees(at.theta_i),
                   stated_degrees(at.rotation), stated_degrees(at.theta_r),
                   stated_degrees(at.phi_r), state_words(result.state[std::size_t(p)]),
                   result.omega_r(p));
    add_cells(Eigen::Array2d(result.weighted(p), result.error(p)), text);
    add_cells(result.f_r.col(p), text);
    add_cells(result.flux(p), text);
    text += '\n';
    if (text.size() > piece) {
      write(text);
      text.clear();
    }
  }
  write(text);
}

}  // namespace gonio
