#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reports/certificate_report.hpp"

// Which budgets a certificate shows, and which of their lines.

namespace gonio {

/// What one input adds to the uncertainty of one reading.
struct BudgetLine {
  const CertificateInput* input;
  const Contribution* contribution;
  double sensitivity_error;  ///< against plain finite differences; NaN if not known
};
/// Those of the inputs that are of this geometry, in their order.
[[nodiscard]] std::vector<BudgetLine> budget_lines(const Certificate& certificate,
                                                   const GeometryCertificate& geometry,
                                                   const CertifiedReading& reading);
/// The same, those that contribute anything, the largest share first.
[[nodiscard]] std::vector<BudgetLine> main_budget_lines(const Certificate& certificate,
                                                        const GeometryCertificate& geometry,
                                                        const CertifiedReading& reading);

/// A sample of which the budget is shown.
struct ShownBudget {
  std::size_t sample;
  std::string why;  ///< empty where all are shown
};
[[nodiscard]] std::vector<ShownBudget> shown_budgets(const CertificateReport& report,
                                                     const GeometryCertificate& geometry);

}  // namespace gonio
