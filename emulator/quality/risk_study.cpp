#include "emulator/quality/risk_study.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "emulator/quality/lot_study.hpp"
#include "emulator/quality/panel_judgement.hpp"
#include "emulator/statistics/sampling_plan.hpp"

namespace gonio {

namespace {

/// How many standard deviations the nearest limit is away.
double room(const Interval& limits, const Moments& panels) {
  double nearest = std::numeric_limits<double>::infinity();
  if (limits.low) {
    nearest = std::min(nearest, panels.mean() - *limits.low);
  }
  if (limits.high) {
    nearest = std::min(nearest, *limits.high - panels.mean());
  }
  return nearest / panels.standard_deviation();
}

const Requirement* narrowest(const Batch& batch, const LotStudy& study) {
  const Requirement* narrowest = nullptr;
  for (const Requirement& requirement : batch.requirements) {
    const Moments& panels = study.channels[requirement.channel].panels;
    if (panels.standard_deviation() > 0.0 &&
        (narrowest == nullptr ||
         room(requirement.limits, panels) <
             room(narrowest->limits, study.channels[narrowest->channel].panels))) {
      narrowest = &requirement;
    }
  }
  return narrowest;
}

std::optional<GlobalRisks> normal_risks(const Batch& batch, const PanelJudge& judge,
                                        const LotStudy& study) {
  const Requirement* requirement = narrowest(batch, study);
  if (requirement == nullptr) {
    return std::nullopt;
  }
  const ChannelTruths& channel = study.channels[requirement->channel];
  const double guard =
      batch.decision.rule == DecisionRule::guarded
          ? batch.decision.guard_band_factor * judge.expanded_uncertainty(requirement->channel)
          : 0.0;
  Interval acceptance = requirement->limits;
  if (acceptance.low) {
    *acceptance.low += guard;
  }
  if (acceptance.high) {
    *acceptance.high -= guard;
  }
  return global_risks(channel.panels.mean(), channel.panels.standard_deviation(),
                      channel.all_errors().root_mean_square(), requirement->limits, acceptance);
}

}  // namespace

Risks risks(const Batch& batch, const ReadingUncertainties& uncertainties,
            const PanelSourceFactory& source, const RiskOptions& options) {
  StudyProgress progress(options, "risks", study_steps(options.lots));
  const LotStudy study = study_lots(batch, uncertainties, *source(batch), options.lots, progress);
  return {.lots = study.lots.all,
          .panels = study.panels.all,
          .lot = study.lots.summary(),
          .panel = study.panels.summary(),
          .panel_normal = normal_risks(batch, PanelJudge(batch, uncertainties), study)};
}

}  // namespace gonio
