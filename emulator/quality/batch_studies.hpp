#pragma once

#include "emulator/optics/colorimetry.hpp"
#include "emulator/quality/batch.hpp"
#include "emulator/quality/qa_result.hpp"
#include "emulator/quality/reading_uncertainty.hpp"
#include "emulator/quality/risk_study.hpp"

namespace gonio {

/// Adds risks, curves and answers to the result of a simulated run.
/// @param observer  of colours, on the visible grid.
void study_product(const Batch& batch, const Observer& observer,
                   const ReadingUncertainties& uncertainties, const RiskOptions& options,
                   QaResult& result);

/// The same for measured readings, of which the normal product is taken that fits them; how a
/// parameter of the product may vary is then not known.
void study_readings(const Batch& batch, const ReadingUncertainties& uncertainties,
                    const RiskOptions& options, QaResult& result);

}  // namespace gonio
