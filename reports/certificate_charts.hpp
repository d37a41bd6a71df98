#pragma once

#include "reports/certificate_report.hpp"
#include "reports/page.hpp"

// The charts of a certificate: each with its caption and the names of its curves.

namespace gonio {

/// Whether it has an opening of known size.
[[nodiscard]] bool has_openings(const GeometryCertificate& geometry);
/// Receptor and image of the source to scale, nominal and as built, over what their limits allow.
[[nodiscard]] PageData apertures_figure(Figures& figures, const GeometryCertificate& geometry);
/// The deviation of each sample with U.
[[nodiscard]] PageData deviation_figure(Figures& figures, const Certificate& certificate,
                                        const GeometryCertificate& geometry);
/// The worst cases of each sample within the limits, and the change as built.
[[nodiscard]] PageData worst_case_figure(Figures& figures, const GeometryCertificate& geometry);
/// The largest shares in the variance of one sample or two, component by component.
[[nodiscard]] PageData budget_figure(Figures& figures, const Certificate& certificate,
                                     const GeometryCertificate& geometry);

}  // namespace gonio
