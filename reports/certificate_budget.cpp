#include "reports/certificate_budget.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gonio {

namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

std::size_t where_largest_uncertainty(const GeometryCertificate& geometry) {
  const auto& readings = geometry.readings;
  return std::size_t(std::max_element(readings.begin(), readings.end(),
                                      [](const CertifiedReading& a, const CertifiedReading& b) {
                                        return a.propagated.expanded_uncertainty <
                                               b.propagated.expanded_uncertainty;
                                      }) -
                     readings.begin());
}

std::size_t where_most_like_reference(const Certificate& certificate,
                                      const GeometryCertificate& geometry) {
  const double value = certificate.standard.scale.value.nominal;
  const auto& readings = geometry.readings;
  return std::size_t(std::min_element(readings.begin(), readings.end(),
                                      [&](const CertifiedReading& a, const CertifiedReading& b) {
                                        return std::abs(a.nominal_gu - value) <
                                               std::abs(b.nominal_gu - value);
                                      }) -
                     readings.begin());
}

}  // namespace

std::vector<BudgetLine> budget_lines(const Certificate& certificate,
                                     const GeometryCertificate& geometry,
                                     const CertifiedReading& reading) {
  std::vector<BudgetLine> lines;
  for (const Contribution& contribution : reading.propagated.budget) {
    if (contribution.input >= certificate.inputs.size()) {
      continue;
    }
    const CertificateInput& input = certificate.inputs[contribution.input];
    if (input.geometry.empty() || input.geometry == geometry.id) {
      const bool is_checked = contribution.input < reading.sensitivity_error.size();
      lines.push_back({&input, &contribution,
                       is_checked ? reading.sensitivity_error[contribution.input] : not_known});
    }
  }
  return lines;
}

std::vector<BudgetLine> main_budget_lines(const Certificate& certificate,
                                          const GeometryCertificate& geometry,
                                          const CertifiedReading& reading) {
  std::vector<BudgetLine> lines = budget_lines(certificate, geometry, reading);
  constexpr double nothing = 1e-6;  // of u: what rounding leaves of zero is less
  std::erase_if(lines, [&](const BudgetLine& line) {
    return line.contribution->contribution <= nothing * reading.propagated.standard_uncertainty;
  });
  std::stable_sort(lines.begin(), lines.end(), [](const BudgetLine& a, const BudgetLine& b) {
    return std::abs(a.contribution->share) > std::abs(b.contribution->share);
  });
  return lines;
}

std::vector<ShownBudget> shown_budgets(const CertificateReport& report,
                                       const GeometryCertificate& geometry) {
  std::vector<ShownBudget> shown;
  if (report.budgets == Budgets::all || geometry.readings.empty()) {
    for (std::size_t i = 0; i < geometry.readings.size(); ++i) {
      shown.push_back({i, ""});
    }
    return shown;
  }
  const std::size_t uncertain = where_largest_uncertainty(geometry);
  const std::size_t alike = where_most_like_reference(report.certificate, geometry);
  shown.push_back({alike, "reads most like the reference"});
  if (uncertain == alike) {
    shown.front().why += ", and has the largest U";
  } else {
    shown.push_back({uncertain, "has the largest U"});
  }
  return shown;
}

}  // namespace gonio
