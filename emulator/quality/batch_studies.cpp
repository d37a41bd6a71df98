#include "emulator/quality/batch_studies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "emulator/quality/normal_panels.hpp"
#include "emulator/quality/product_panels.hpp"

namespace gonio {

namespace {

/// How far a curve may move a parameter, in the order of sample_parameter_names.
constexpr ProductDeviation curve_reach{0.6, 0.1, 0.1};
/// Of a curve, beyond the limits, in standard deviations of panel means.
constexpr double curve_margin = 4.0;

/// Panels of a batch that lives as long as they do.
class OwnProductPanels : public PanelSource {
 public:
  OwnProductPanels(Batch batch, const ProductOptics& optics,
                   const ReadingUncertainties& uncertainties)
      : batch_(std::move(batch)), panels_(batch_, optics, uncertainties) {}

  [[nodiscard]] PanelRecord inspect(std::uint64_t number) const override {
    return panels_.inspect(number);
  }
  [[nodiscard]] LotTruth truth(std::uint64_t lot) const override { return panels_.truth(lot); }

 private:
  Batch batch_;
  ProductPanels panels_;
};

/// The batch as if nothing but that were required.
Batch with_one_requirement(const Batch& batch, const Requirement& requirement) {
  Batch one = batch;
  one.requirements = {requirement};
  one.selected_only = false;
  return one;
}

/// Which parameter moves the gloss of the product: its roughness, if it has one.
std::size_t moving_parameter(const SampleFamily& family) {
  std::size_t p = 0;
  while (p + 1 < sample_parameter_count && !family.has(SampleParameter(p))) {
    ++p;
  }
  return p;
}

/// The mean of a channel, were there no spread.
double mean_at(Batch batch, const ProductOptics& optics, const ReadingUncertainties& uncertainties,
               std::uint32_t channel) {
  batch.product->spread = {};
  return ProductPanels(batch, optics, uncertainties).truth(1).mean[channel];
}

/// Offsets for which the mean is not far from the limits.
std::pair<double, double> curve_range(const std::function<double(double)>& mean, double reach,
                                      const Interval& limits, double margin) {
  constexpr int steps = 60;
  const double low = limits.low.value_or(-HUGE_VAL) - margin;
  const double high = limits.high.value_or(HUGE_VAL) + margin;
  // One limit alone: as far on its other side.
  const double lowest = limits.low ? low : *limits.high - 2.0 * margin;
  const double highest = limits.high ? high : *limits.low + 2.0 * margin;
  std::pair<double, double> range{reach, -reach};
  for (int i = -steps; i <= steps; ++i) {
    const double offset = reach * i / steps;
    if (const double g = mean(offset); g >= lowest && g <= highest) {
      range = {std::min(range.first, offset), std::max(range.second, offset)};
    }
  }
  return range.first < range.second ? range : std::pair{-reach, reach};
}

class ProductStudy {
 public:
  ProductStudy(const Batch& batch, const ProductOptics& optics,
               const ReadingUncertainties& uncertainties, const RiskOptions& options)
      : batch_(batch), optics_(optics), uncertainties_(uncertainties), options_(options) {}

  void add_to(QaResult& result) const {
    const PanelSourceFactory source = [this](const Batch& changed) {
      return std::make_unique<OwnProductPanels>(changed, optics_, uncertainties_);
    };
    result.risks = risks(batch_, uncertainties_, source, options_);
    for (const Requirement& requirement : batch_.requirements) {
      if (batch_.channels[requirement.channel].kind == BatchChannel::Kind::gloss) {
        result.oc_curves.push_back(curve(requirement, result));
      }
    }
    result.readings_answer = readings_for_risk(batch_, uncertainties_, source, options_);
    for (std::size_t p = 0; p < sample_parameter_count; ++p) {
      if (batch_.product->spread[p].total() > 0.0) {
        result.spread_answers.push_back(
            spread_for_risk(batch_, p, uncertainties_, source, options_));
      }
    }
  }

 private:
  [[nodiscard]] OcCurve curve(const Requirement& requirement, const QaResult& result) const {
    const std::size_t parameter = moving_parameter(optics_.family());
    const Batch one = with_one_requirement(batch_, requirement);
    const auto shifted = [&](double offset) {
      Batch moved = one;
      moved.product->offset[parameter] += offset;
      return moved;
    };
    const std::uint32_t c = requirement.channel;
    const auto [low, high] = curve_range(
        [&](double offset) { return mean_at(shifted(offset), optics_, uncertainties_, c); },
        curve_reach[parameter], requirement.limits,
        curve_margin * std::max(result.channels.at(c).standard_deviation,
                                0.5 * result.channels.at(c).expanded_uncertainty));
    return operating_characteristic(one, uncertainties_,
                                    {.channel = c,
                                     .parameter = sample_parameter_names[parameter],
                                     .low = low,
                                     .high = high,
                                     .shifted =
                                         [&](double offset) {
                                           return std::make_unique<OwnProductPanels>(
                                               shifted(offset), optics_, uncertainties_);
                                         }},
                                    options_);
  }

  const Batch& batch_;
  const ProductOptics& optics_;
  const ReadingUncertainties& uncertainties_;
  const RiskOptions& options_;
};

}  // namespace

void study_product(const Batch& batch, const Observer& observer,
                   const ReadingUncertainties& uncertainties, const RiskOptions& options,
                   QaResult& result) {
  ProductDeviation far = reach(batch);
  const std::size_t moving =
      moving_parameter(SampleFamily::load(batch.product.value().sample, WavelengthGrid::visible()));
  for (std::size_t p = 0; p < far.size(); ++p) {
    far[p] *= largest_spread_factor;
  }
  far[moving] = std::max(far[moving], reach(batch)[moving] + curve_reach[moving]);
  const ProductOptics optics(batch, far, observer);
  ProductStudy(batch, optics, uncertainties, options).add_to(result);
  result.remarks.push_back(
      fmt::format("Risks, curves and answers rest on polynomials in place of the optics, which err "
                  "by {:.2g} GU at most.",
                  optics.error()));
}

void study_readings(const Batch& batch, const ReadingUncertainties& uncertainties,
                    const RiskOptions& options, QaResult& result) {
  const NormalProduct product = normal_product(result);
  const PanelSourceFactory source = [&](const Batch& changed) {
    return std::make_unique<NormalPanels>(changed, uncertainties, product);
  };
  result.risks = risks(batch, uncertainties, source, options);
  result.risks->from_normal_model = true;
  for (const Requirement& requirement : batch.requirements) {
    const std::uint32_t c = requirement.channel;
    if (batch.channels[c].kind != BatchChannel::Kind::gloss) {
      continue;
    }
    const Batch one = with_one_requirement(batch, requirement);
    const double mean = product.channels.at(c).mean;
    const double margin = curve_margin * std::max(result.channels.at(c).standard_deviation,
                                                  0.5 * result.channels.at(c).expanded_uncertainty);
    const Interval& limits = requirement.limits;
    const double low = limits.low.value_or(limits.high.value_or(mean) - margin) - margin;
    const double high = limits.high.value_or(limits.low.value_or(mean) + margin) + margin;
    result.oc_curves.push_back(operating_characteristic(
        one, uncertainties,
        {.channel = c,
         .parameter = "mean",
         .low = low - mean,
         .high = high - mean,
         .shifted =
             [&](double offset) {
               NormalProduct moved = product;
               moved.channels[c].mean += offset;
               return std::make_unique<NormalPanels>(one, uncertainties, moved);
             }},
        options));
  }
  result.readings_answer = readings_for_risk(batch, uncertainties, source, options);
}

}  // namespace gonio
