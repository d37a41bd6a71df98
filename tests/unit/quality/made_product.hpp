#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emulator/instrument/glossmeter.hpp"
#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/quality/product_panels.hpp"
#include "tests/unit/quality/made_batch.hpp"

namespace gonio::test {

inline Observer observer_1931() {
  return Observer::load(std::string(GONIO_SOURCE_DIR) + "/fixtures/observers/cie_1931_2deg.csv",
                        WavelengthGrid::visible());
}

/// A batch with a product of a shipped sample, which does not vary.
struct MadeProduct {
  MadeProduct(const std::string& sample, const std::vector<std::string>& geometries)
      : batch(made_batch(geometries)) {
    batch.product =
        Product{.sample = std::string(GONIO_SOURCE_DIR) + "/fixtures/samples/" + sample + ".yaml"};
    batch.plan.panels = 1'000'000;
    uncertainties = same_uncertainty(batch, 0.0);
  }

  /// Panels as the batch is now, with optics that reach as far as it needs.
  ProductPanels panels() {
    optics_ = std::make_unique<ProductOptics>(batch, reach(batch), observer_1931());
    if (uncertainties.size() != batch.instruments.size() * batch.channels.size()) {
      uncertainties = same_uncertainty(batch, 0.0);
    }
    return {batch, *optics_, uncertainties};
  }
  [[nodiscard]] const ProductOptics& optics() const { return *optics_; }

  static ParameterSpread normal(double lots, double panels, double within) {
    return {.lots = {.standard_uncertainty = lots},
            .panels = {.standard_uncertainty = panels},
            .within_panel = within};
  }

  /// Through the integrator, by the nominal instrument.
  [[nodiscard]] double gloss(std::uint32_t channel, const SampleDeviation& deviation = {},
                             std::size_t region = 0) const {
    const Glossmeter glossmeter(nominal_instrument(batch.standard), WavelengthGrid::visible(),
                                std::make_shared<ApertureIntegrator>());
    const auto family = SampleFamily::load(batch.product->sample, WavelengthGrid::visible());
    return glossmeter
        .read(family.surface(region, deviation), batch.channels[channel].geometry, 1e-5)
        .gloss;
  }

  /// Derivative of the gloss in the first channel, by differences.
  [[nodiscard]] double slope(std::size_t parameter) const {
    constexpr double step = 1e-3;
    SampleDeviation up, down;
    up[SampleParameter(parameter)] = step;
    down[SampleParameter(parameter)] = -step;
    return (gloss(0, up) - gloss(0, down)) / (2.0 * step);
  }

  Batch batch;
  ReadingUncertainties uncertainties;

 private:
  std::unique_ptr<ProductOptics> optics_;
};

}  // namespace gonio::test
