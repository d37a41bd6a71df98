#pragma once

#include <string>
#include <vector>

#include "emulator/procedure/certificate.hpp"

namespace gonio {

/// How a value is judged by its limits.
struct JudgementRule {
  DecisionRule rule = DecisionRule::guarded;
  double guard_band_factor = 1.0;  ///< guard band in expanded uncertainties, >= 0
};

/// Every quantity that the instrument's file states and a clause limits: angles and openings, the
/// offset of the image, linearity, zero and drift; in the order of the clauses.
///
/// The zero is 0 as uncertain as it is stated; drift is that of the lamp over the interval of
/// calibration, on a tile that reads the value of the scale.
/// @param geometry_ids  those that are certified.
[[nodiscard]] std::vector<CertificateLimit> judge_limits(
    const Instrument& instrument, const ClauseSet& clauses,
    const std::vector<std::string>& geometry_ids, const JudgementRule& rule);

/// The verdict on a set-up: the worst of the limits that count; inconclusive if none of them does.
[[nodiscard]] ConformanceVerdict verdict_of(const std::vector<CertificateLimit>& limits);

}  // namespace gonio
