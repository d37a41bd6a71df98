#include "emulator/quality/product_optics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "emulator/instrument/glossmeter.hpp"
#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/optics/colorimetry.hpp"
#include "emulator/surface/panel_layout.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXXd;
using Eigen::Index;
using Eigen::VectorXd;

/// Of what is normal, in standard deviations: one draw in 500 million lies beyond.
constexpr double normal_reach = 6.0;
/// Asked of a polynomial, relative to what is seen of the product as it is, and at least: a tenth
/// of what displays show is far more.
constexpr double relative_error = 1e-5;
constexpr double least_error = 2e-4;
/// The integrator errs by that share of it.
constexpr double integrator_share = 0.05;

SampleDeviation deviation_of(const VectorXd& d) {
  return {.roughness = d[0], .refractive_index = d[1], .diffuse_reflectance = d[2]};
}

/// What one instrument sees in one geometry, through its optics themselves.
class Eye {
 public:
  Eye(const Instrument& instrument, const BatchChannel& channel, const Observer& observer)
      : channel_(channel),
        observer_(observer),
        glossmeter_(instrument, WavelengthGrid::visible(), std::make_shared<ApertureIntegrator>()),
        white_(white_point(glossmeter_.source(), observer)) {}

  [[nodiscard]] VectorXd see(const Surface& surface, double tolerance) const {
    const GlossReading reading = glossmeter_.read(surface, channel_.geometry, tolerance);
    if (channel_.kind == BatchChannel::Kind::gloss) {
      return VectorXd::Constant(1, reading.gloss);
    }
    const Xyz xyz = tristimulus(reading.reflectance, glossmeter_.source(), observer_);
    return Eigen::Vector3d(xyz.X / white_.X, xyz.Y / white_.Y, xyz.Z / white_.Z);
  }

 private:
  const BatchChannel& channel_;
  const Observer& observer_;
  Glossmeter glossmeter_;
  Xyz white_;
};

Lab lab_of(const ProductOptics::Seen& seen) {
  return cielab({seen[0], seen[1], seen[2]}, {1.0, 1.0, 1.0});
}

}  // namespace

ProductDeviation reach(const Batch& batch) {
  ProductDeviation far{};
  for (std::size_t p = 0; p < far.size(); ++p) {
    const ParameterSpread& spread = batch.product.value().spread[p];
    double variance = spread.within_panel * spread.within_panel;
    for (const Distribution& level : {spread.lots, spread.panels}) {
      if (std::isfinite(level.half_width())) {
        far[p] += level.half_width();
      } else {
        variance += level.standard_uncertainty * level.standard_uncertainty;
      }
    }
    far[p] += normal_reach * std::sqrt(variance);
  }
  return far;
}

ProductOptics::ProductOptics(const Batch& batch, const ProductDeviation& half_width,
                             const Observer& observer,
                             const std::function<void(std::size_t, std::size_t)>& advance)
    : batch_(batch),
      half_width_(half_width),
      family_(SampleFamily::load(batch.product.value().sample, WavelengthGrid::visible())),
      ideal_(nominal_instrument(batch.standard)) {
  if (const PanelLayout* layout = family_.layout()) {
    for (std::size_t i = 0; i < layout->maps.size(); ++i) {
      if (const auto& map = layout->maps[i]) {
        half_width_[i] += std::max(std::abs(map->lowest()), std::abs(map->highest()));
      }
    }
  }
  seen_.resize((ideal() + 1) * batch.channels.size() * family_.regions());
  equations_.resize((ideal() + 1) * batch.channels.size());
  for (std::size_t p = 0; p < seen_.size(); ++p) {  // each fit runs on all cores
    fit(p, observer);
    if (advance) {
      advance(p + 1, seen_.size());
    }
  }
  set_references(observer);
}

const Instrument& ProductOptics::instrument(std::size_t number) const {
  return number == ideal() ? ideal_ : batch_.instruments.at(number);
}

std::size_t ProductOptics::place(std::size_t instrument, std::uint32_t channel,
                                 std::size_t region) const {
  return (instrument * batch_.channels.size() + channel) * family_.regions() + region;
}

void ProductOptics::fit(std::size_t p, const Observer& observer) {
  const std::size_t region = p % family_.regions();
  const std::size_t of_channel = p / family_.regions();
  const BatchChannel& channel = batch_.channels[of_channel % batch_.channels.size()];
  if (channel.kind == BatchChannel::Kind::haze) {
    return;
  }
  const Instrument& seeing = instrument(of_channel / batch_.channels.size());
  if (channel.kind == BatchChannel::Kind::gloss) {
    equations_[of_channel] = measurement_equation(seeing, channel.geometry);
  }
  const Eye eye(seeing, channel, observer);
  const ProductDeviation& offset = batch_.product->offset;
  const VectorXd centre = Eigen::Map<const VectorXd>(offset.data(), Index(offset.size()));
  const VectorXd half_width =
      Eigen::Map<const VectorXd>(half_width_.data(), Index(half_width_.size()));
  const auto see = [&](const VectorXd& deviation, double tolerance) {
    return eye.see(family_.surface(region, deviation_of(deviation)), tolerance);
  };
  try {
    const double scale = see(centre, 1e-3).cwiseAbs().maxCoeff();
    const double target = channel.kind == BatchChannel::Kind::gloss
                              ? std::max(least_error, relative_error * scale)
                              : relative_error * scale;
    // The tolerance of a colour is that of gloss as well: both come from the same flux.
    const double tolerance = integrator_share * std::max(least_error, relative_error * scale);
    seen_[p] = PolynomialSurrogate::fit(
        [&](const VectorXd& deviation) { return see(deviation, tolerance); }, centre, half_width,
        {.target_error = target});
  } catch (const std::domain_error& error) {
    throw InputError(batch_.product->mark, "deviations that the sample's model has a meaning for",
                     error.what());
  }
  error_ = std::max(error_, seen_[p]->error().maxCoeff());
}

/// Of the product as its file says, in the eyes of the ideal instrument, where the batch names
/// none.
void ProductOptics::set_references(const Observer& observer) {
  references_.resize(batch_.channels.size());
  for (std::uint32_t c = 0; c < batch_.channels.size(); ++c) {
    if (batch_.channels[c].kind == BatchChannel::Kind::colour_difference) {
      if (const auto& stated = batch_.colour_references.at(c)) {
        references_[c] = {(*stated)[0], (*stated)[1], (*stated)[2]};
        continue;
      }
      const VectorXd seen = Eye(ideal_, batch_.channels[c], observer)
                                .see(family_.sample().surface, least_error * integrator_share);
      references_[c] = lab_of({seen[0], seen[1], seen[2]});
    }
  }
}

ProductOptics::Seen ProductOptics::see(std::size_t instrument, std::uint32_t channel,
                                       std::size_t region, const Eigen::Vector3d& deviation) const {
  const ArrayXXd x = deviation.transpose().array();
  ArrayXXd y;
  seen_.at(place(instrument, channel, region)).value().evaluate(x, y);
  Seen seen{};
  for (Index i = 0; i < y.cols(); ++i) {
    seen[std::size_t(i)] = y(0, i);
  }
  return seen;
}

double ProductOptics::show(std::size_t instrument, std::uint32_t channel, const Seen& seen) const {
  if (batch_.channels[channel].kind == BatchChannel::Kind::colour_difference) {
    return ciede2000(lab_of(seen), references_[channel]);
  }
  if (instrument == ideal()) {
    return seen[0];
  }
  MeasurementEquation::Components<double> d{};
  d[std::size_t(UncertaintyComponent::linearity)] =
      batch_.instruments[instrument].behaviour.linearity;
  return equations_[instrument * batch_.channels.size() + channel].reading(seen[0], d);
}

}  // namespace gonio
