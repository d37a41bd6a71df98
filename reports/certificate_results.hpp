#pragma once

#include "reports/certificate_report.hpp"
#include "reports/page.hpp"

namespace gonio {

/// What the page of a certificate shows of one geometry: readings, charts, effects, worst cases and
/// budgets.
[[nodiscard]] PageData geometry_data(Figures& figures, const CertificateReport& report,
                                     const GeometryCertificate& geometry);

}  // namespace gonio
