#include "emulator/measured/brdf_resampling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "emulator/measured/brdf_points.hpp"
#include "emulator/measured/incidence_frame.hpp"

namespace gonio {

namespace {

using Eigen::Index;
using std::numbers::pi;

/// Multiples of a step in [0, end), and `centre` with what lies at fine steps, each twice the one
/// before, about it.
Eigen::ArrayXd refined(double step, double end, double centre, double fine) {
  std::vector<double> angles;
  for (Index i = 0; double(i) * step < end - same_angle; ++i) {
    angles.push_back(double(i) * step);
  }
  angles.push_back(centre);
  for (double offset = fine; offset < 2.0 * step; offset *= 2.0) {
    for (const double angle : {centre - offset, centre + offset}) {
      if (angle > 0.0 && angle < end) {
        angles.push_back(angle);
      }
    }
  }
  // nodes next to one another give nothing new
  std::ranges::sort(angles);
  std::vector<double> apart;
  for (const double angle : angles) {
    if (apart.empty() || angle - apart.back() > 0.4 * fine || angle == centre) {
      if (angle == centre && !apart.empty() && angle - apart.back() <= 0.4 * fine) {
        apart.pop_back();
      }
      apart.push_back(angle);
    }
  }
  return Eigen::Map<const Eigen::ArrayXd>(apart.data(), Index(apart.size()));
}

/// Directions of reflection of one incidence.
struct ReflectionGrid {
  Eigen::ArrayXd theta, azimuth;
};

ReflectionGrid reflection_grid(const MeasuredBrdf& brdf, const BrdfSampling& sampling,
                               Angle theta_i) {
  constexpr double finest = 1e-3;
  const double theta_step = sampling.theta_step.radians();
  const double azimuth_step = sampling.azimuth_step.radians();
  const double fine = std::clamp(brdf.step(theta_i).radians(), finest, theta_step / 4.0);
  const double round =
      std::clamp(fine / std::max(std::sin(theta_i.radians()), finest), finest, azimuth_step);
  const double margin = 1e-3;  // at the horizon itself nothing is seen
  ReflectionGrid grid{.theta = refined(theta_step, pi / 2.0 - margin,
                                       std::min(theta_i.radians(), pi / 2.0 - margin), fine),
                      .azimuth = refined(azimuth_step, pi, 0.0, round)};
  const Index n = grid.azimuth.size();
  grid.azimuth.conservativeResize(n + 1);
  grid.azimuth[n] = pi;
  if (sampling.rotation.size() > 1) {
    const Eigen::ArrayXd half = grid.azimuth;
    grid.azimuth.resize(2 * n);
    grid.azimuth << half, -half.segment(1, n - 1).reverse();
  }
  return grid;
}

std::vector<Angle> incidences(const MeasuredBrdf& brdf, const BrdfSampling& sampling) {
  if (!sampling.theta_i.empty()) {
    return sampling.theta_i;
  }
  std::vector<Angle> angles;
  const double largest_deg = std::min(brdf.largest_theta().degrees(), 85.0);
  for (double theta_deg = 0.0; theta_deg < largest_deg + 1e-6; theta_deg += 5.0) {
    angles.push_back(degrees(theta_deg));
  }
  return angles;
}

}  // namespace

BrdfSamples sample_brdf(const MeasuredBrdf& brdf, const BrdfSampling& sampling) {
  struct Part {
    Angle theta_i, rotation;
    ReflectionGrid grid;
  };
  std::vector<Part> parts;
  Index n = 0;
  for (const Angle rotation : sampling.rotation) {
    for (const Angle theta_i : incidences(brdf, sampling)) {
      parts.push_back({theta_i, rotation, reflection_grid(brdf, sampling, theta_i)});
      n += parts.back().grid.theta.size() * parts.back().grid.azimuth.size();
      if (n > most_brdf_samples) {
        throw std::invalid_argument(
            fmt::format("expected a grid of at most {} samples: take larger steps, or fewer angles "
                        "of incidence",
                        most_brdf_samples));
      }
    }
  }
  BrdfSamples samples{.channels = brdf.channels()};
  samples.theta_i = samples.phi_i = samples.theta_r = samples.phi_r = Eigen::ArrayXd(n);
  samples.f_r.resize(n, Index(samples.channels.size()));
  Index begin = 0;
  for (const Part& part : parts) {
    const Index size = part.grid.theta.size() * part.grid.azimuth.size();
    const Index n_azimuth = part.grid.azimuth.size();
    const double phi_i = pi + part.rotation.radians();
    DirectionBatch omega_r;
    omega_r.resize(size);
    for (Index i = 0; i < size; ++i) {
      const double theta = part.grid.theta[i / n_azimuth];
      const double phi = part.rotation.radians() + part.grid.azimuth[i % n_azimuth];
      samples.theta_r[begin + i] = theta;
      samples.phi_r[begin + i] = phi;
      omega_r.x[i] = std::sin(theta) * std::cos(phi);
      omega_r.y[i] = std::sin(theta) * std::sin(phi);
      omega_r.z[i] = std::cos(theta);
    }
    const double sin_i = std::sin(part.theta_i.radians());
    Eigen::ArrayXXd f_r(size, samples.f_r.cols());
    brdf.evaluate(
        {sin_i * std::cos(phi_i), sin_i * std::sin(phi_i), std::cos(part.theta_i.radians())},
        omega_r, f_r);
    samples.theta_i.segment(begin, size) = part.theta_i.radians();
    samples.phi_i.segment(begin, size) = phi_i;
    samples.f_r.middleRows(begin, size) = f_r;
    begin += size;
  }
  return samples;
}

Eigen::MatrixXd channel_conversion(const std::vector<BrdfChannel>& from,
                                   const std::vector<BrdfChannel>& to) {
  using Band = BrdfChannel::Band;
  constexpr std::array<std::pair<Band, double>, 3> luminance{
      {{Band::red, 0.2126}, {Band::green, 0.7152}, {Band::blue, 0.0722}}};
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(Index(from.size()), Index(to.size()));
  const auto row_of = [&](const BrdfChannel& channel) -> Index {
    const auto found = std::ranges::find(from, channel);
    return found == from.end() ? -1 : found - from.begin();
  };
  for (std::size_t i = 0; i < to.size(); ++i) {
    const auto column = Index(i);
    if (const Index itself = row_of(to[i]); itself >= 0) {
      matrix(itself, column) = 1.0;
    } else if (const Index y = row_of({.band = Band::y}); to[i].band == Band::luminance && y >= 0) {
      matrix(y, column) = 1.0;
    } else if (to[i].band == Band::luminance && row_of({.band = Band::green}) >= 0) {
      for (const auto& [band, weight] : luminance) {
        matrix(row_of({.band = band}), column) = weight;
      }
    } else {
      throw std::invalid_argument(
          fmt::format("expected a channel of the file, which has {} to {}, found '{}'",
                      channel_name(from.front()), channel_name(from.back()), channel_name(to[i])));
    }
  }
  return matrix;
}

namespace {

class ConvertedBrdf : public MeasuredBrdf {
 public:
  ConvertedBrdf(std::shared_ptr<const MeasuredBrdf> brdf, std::vector<BrdfChannel> channels)
      : brdf_(std::move(brdf)),
        channels_(std::move(channels)),
        matrix_(channel_conversion(brdf_->channels(), channels_)) {}

  [[nodiscard]] const std::vector<BrdfChannel>& channels() const override { return channels_; }
  void evaluate(const Vector3& omega_i, const DirectionBatch& omega_r,
                Eigen::Ref<Eigen::ArrayXXd> f_r) const override {
    Eigen::ArrayXXd all(omega_r.size(), matrix_.rows());
    brdf_->evaluate(omega_i, omega_r, all);
    f_r = (all.matrix() * matrix_).array();
  }
  [[nodiscard]] Angle step(Angle theta_i) const override { return brdf_->step(theta_i); }
  [[nodiscard]] Angle largest_theta() const override { return brdf_->largest_theta(); }

 private:
  std::shared_ptr<const MeasuredBrdf> brdf_;
  std::vector<BrdfChannel> channels_;
  Eigen::MatrixXd matrix_;
};

}  // namespace

std::shared_ptr<const MeasuredBrdf> with_channels(std::shared_ptr<const MeasuredBrdf> brdf,
                                                  std::vector<BrdfChannel> channels) {
  return std::make_shared<ConvertedBrdf>(std::move(brdf), std::move(channels));
}

}  // namespace gonio
