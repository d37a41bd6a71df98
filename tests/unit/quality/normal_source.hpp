#pragma once

#include <cmath>
#include <memory>
#include <utility>

#include "emulator/quality/normal_panels.hpp"
#include "emulator/quality/panel_source.hpp"
#include "emulator/statistics/estimate.hpp"

namespace gonio::test {

/// Of intervals about shares that are simulated: chance leaves one in ten thousand.
constexpr double nearly_all = 0.9999;

/// Whether simulation allows for an exact share. @param trials  that the estimate is of.
inline bool allows(const Estimate& estimate, std::size_t trials, double exact) {
  const auto successes = std::size_t(std::lround(estimate.value * double(trials)));
  const Estimate wide = proportion(successes, trials, nearly_all);
  return wide.low <= exact && exact <= wide.high;
}

/// Makes normal panels, the same product for any batch.
inline PanelSourceFactory normal_source(const ReadingUncertainties& uncertainties,
                                        NormalProduct product) {
  return [&uncertainties, product = std::move(product)](const Batch& batch) {
    return std::make_unique<NormalPanels>(batch, uncertainties, product);
  };
}

}  // namespace gonio::test
