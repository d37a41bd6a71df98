#pragma once

#include <string>
#include <vector>

#include "emulator/goniometry/validation.hpp"
#include "reports/report_table.hpp"

// What a validation is told in, the same on a terminal and on a page.

namespace gonio {

/// "smooth", "energy conserving" or "as printed".
[[nodiscard]] std::string model_words(ValidationModel model);
/// "apertures" or "patches".
[[nodiscard]] std::string integrator_words(ValidationIntegrator integrator);
/// What the method is and what its figures mean, a sentence each.
[[nodiscard]] std::vector<std::string> validation_method(const ValidationPlan& plan);

/// What the figures say, a sentence for each material and one of the patch method.
[[nodiscard]] std::vector<std::string> validation_findings(const ValidationPlan& plan,
                                                           const ValidationResult& result);

/// The figures of the publication beside ours, for the first refractive index of each material.
[[nodiscard]] ReportTable printed_table(const ValidationPlan& plan, const ValidationResult& result);
/// By how much the refractive index alone changes a result, of one material.
[[nodiscard]] ReportTable author_table(const ValidationPlan& plan, const ValidationResult& result,
                                       std::size_t material);
/// The patch method at all resolutions against the aperture integrator.
[[nodiscard]] ReportTable convergence_table(const ValidationPlan& plan,
                                            const ValidationResult& result);

}  // namespace gonio
