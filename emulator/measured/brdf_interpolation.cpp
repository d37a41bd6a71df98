#include "emulator/measured/brdf_interpolation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "emulator/measured/bracket.hpp"
#include "emulator/measured/brdf_slice.hpp"
#include "emulator/measured/incidence_frame.hpp"
#include "emulator/measured/nearest_points.hpp"
#include "emulator/measured/specular_table.hpp"

namespace gonio {

namespace {

using Eigen::Index;
using std::numbers::pi;

/// Rows of points by what `key` says of each: distinct keys, and the rows of each of them.
template <typename Key>
std::pair<Eigen::ArrayXd, std::vector<std::vector<Index>>> grouped(const std::vector<Index>& rows,
                                                                   const Key& key) {
  std::vector<double> keys;
  for (const Index row : rows) {
    keys.push_back(key(row));
  }
  const Eigen::ArrayXd distinct = distinct_angles(keys);
  std::vector<std::vector<Index>> groups(std::size_t(distinct.size()));
  for (const Index row : rows) {
    groups[std::size_t(index_of_angle(distinct, key(row)))].push_back(row);
  }
  return {distinct, groups};
}

std::vector<Index> all_rows(const BrdfPoints& points) {
  std::vector<Index> rows(std::size_t(points.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i] = Index(i);
  }
  return rows;
}

/// The incidences of points: polar angles, and at each of them rotations.
struct Incidences {
  struct OfOneTheta {
    Eigen::ArrayXd rotation;
    std::vector<std::vector<Index>> rows;  ///< of points, by rotation
  };
  Eigen::ArrayXd theta_i;
  std::vector<OfOneTheta> groups;
};

Incidences incidences_of(const BrdfPoints& points) {
  Incidences result;
  auto [theta_i, by_theta] =
      grouped(all_rows(points), [&](Index row) { return points.theta_i[row]; });
  result.theta_i = theta_i;
  for (const auto& rows : by_theta) {
    auto [rotation, by_rotation] =
        grouped(rows, [&](Index row) { return points.is_isotropic ? 0.0 : points.rotation[row]; });
    result.groups.push_back({.rotation = rotation, .rows = by_rotation});
  }
  return result;
}

/// Each incidence with its own grid of directions of reflection.
class SlicedBrdf : public MeasuredBrdf {
 public:
  /// Nothing where directions are on no grid.
  static std::unique_ptr<SlicedBrdf> of(const BrdfPoints& points,
                                        const std::vector<BrdfChannel>& channels,
                                        BrdfSlice::Report& report) {
    auto result = std::make_unique<SlicedBrdf>();
    result->channels_ = channels;
    const Incidences incidences = incidences_of(points);
    result->theta_i_ = incidences.theta_i;
    for (const auto& group : incidences.groups) {
      Rotations& rotations = result->rotations_.emplace_back();
      rotations.angle = group.rotation;
      for (const auto& rows : group.rows) {
        auto slice = BrdfSlice::on_grid(points, rows, report);
        if (!slice) {
          return nullptr;
        }
        rotations.slices.push_back(std::move(*slice));
      }
    }
    return result;
  }

  [[nodiscard]] const std::vector<BrdfChannel>& channels() const override { return channels_; }

  void evaluate(const Vector3& omega_i, const DirectionBatch& omega_r,
                Eigen::Ref<Eigen::ArrayXXd> f_r) const override {
    f_r.setZero();
    if (omega_i.z() <= 0.0) {
      return;
    }
    const IncidenceFrame frame(omega_i);
    const Bracket theta = bracket(theta_i_, frame.theta_i());
    Eigen::ArrayXd values(f_r.cols());
    for (Index i = 0; i < omega_r.size(); ++i) {
      if (omega_r.z[i] <= 0.0) {
        continue;
      }
      const Vector3 local = frame.local(omega_r.x[i], omega_r.y[i], omega_r.z[i]);
      values.setZero();
      add(theta.first, 1.0 - theta.weight, frame, local, values);
      add(theta.second, theta.weight, frame, local, values);
      f_r.row(i) = values.transpose().square().square();
    }
  }

  [[nodiscard]] Angle step(Angle theta_i) const override {
    const Index nearest = bracket(theta_i_, theta_i.radians()).nearest();
    return radians(rotations_[std::size_t(nearest)].slices.front().step(theta_i.radians()));
  }

  [[nodiscard]] Angle largest_theta() const override {
    return radians(theta_i_[theta_i_.size() - 1]);
  }

 private:
  struct Rotations {
    Eigen::ArrayXd angle;
    std::vector<BrdfSlice> slices;
  };

  void add(Index i_theta, double weight, const IncidenceFrame& frame, const Vector3& local,
           Eigen::ArrayXd& values) const {
    if (weight == 0.0) {
      return;
    }
    const Rotations& rotations = rotations_[std::size_t(i_theta)];
    const Vector3 there = moved_with_lobe(local, frame.theta_i(), theta_i_[i_theta]);
    if (rotations.slices.size() == 1) {
      rotations.slices.front().add(there, weight, values);
      return;
    }
    const Bracket rotation = bracket_on_circle(rotations.angle, frame.rotation());
    rotations.slices[std::size_t(rotation.first)].add(there, weight * (1.0 - rotation.weight),
                                                      values);
    rotations.slices[std::size_t(rotation.second)].add(there, weight * rotation.weight, values);
  }

  std::vector<BrdfChannel> channels_;
  Eigen::ArrayXd theta_i_;
  std::vector<Rotations> rotations_;
};

/// f_r along the plane of incidence, linear between points; theta is negative towards the source.
class Profile {
 public:
  Profile(const BrdfPoints& points, const std::vector<Index>& rows) {
    std::vector<std::pair<double, Index>> order;
    for (const Index row : rows) {
      order.emplace_back(points.azimuth[row] == 0.0 ? points.theta_r[row] : -points.theta_r[row],
                         row);
    }
    std::ranges::sort(order);
    theta_.resize(Index(order.size()));
    f_r_.resize(Index(order.size()), points.f_r.cols());
    for (Index i = 0; i < theta_.size(); ++i) {
      theta_[i] = order[std::size_t(i)].first;
      f_r_.row(i) = points.f_r.row(order[std::size_t(i)].second);
    }
  }

  [[nodiscard]] const Eigen::ArrayXd& theta() const { return theta_; }
  [[nodiscard]] bool reaches(double theta) const {
    return theta >= theta_[0] - same_angle && theta <= theta_[theta_.size() - 1] + same_angle;
  }
  [[nodiscard]] Eigen::ArrayXd at(double theta) const {
    const Bracket here = bracket(theta_, theta);
    return ((1.0 - here.weight) * f_r_.row(here.first) + here.weight * f_r_.row(here.second))
        .transpose();
  }

 private:
  Eigen::ArrayXd theta_;
  Eigen::ArrayXXd f_r_;
};

/// All profiles on one grid about the mirror direction, between whose azimuths 0 and pi the table
/// fills in. Nothing if incidences are on no grid, or angles too many.
std::unique_ptr<const MeasuredBrdf> table_of_profiles(const BrdfPoints& points,
                                                      const std::vector<BrdfChannel>& channels) {
  const Incidences incidences = incidences_of(points);
  std::vector<double> radial{0.0};
  std::vector<Profile> profiles;
  for (Index i = 0; i < incidences.theta_i.size(); ++i) {
    const auto& group = incidences.groups[std::size_t(i)];
    const Eigen::ArrayXd& first = incidences.groups.front().rotation;
    if (group.rotation.size() != first.size() ||
        ((group.rotation - first).abs() > 2.0 * same_angle).any()) {
      return nullptr;
    }
    for (const auto& rows : group.rows) {
      profiles.emplace_back(points, rows);
      for (const double theta : profiles.back().theta()) {
        radial.push_back(std::abs(theta - incidences.theta_i[i]));
      }
    }
  }
  SpecularTable::Grid grid{.rotation = incidences.groups.front().rotation,
                           .theta_i = incidences.theta_i,
                           .azimuth = Eigen::ArrayXd::LinSpaced(2, 0.0, pi),
                           .radial = distinct_angles(radial)};
  constexpr double most_nodes = 2e7;
  if (double(grid.size()) * double(channels.size()) > most_nodes) {
    return nullptr;
  }
  Eigen::ArrayXXd f_r(grid.size(), Index(channels.size()));
  const auto n_rotations = grid.rotation.size();
  for (Index i = 0; i < Index(profiles.size()); ++i) {
    const Profile& profile = profiles[std::size_t(i)];
    const Index i_theta = i / n_rotations, i_rotation = i % n_rotations;
    for (Index j = 0; j < grid.radial.size(); ++j) {
      const double to_normal = grid.theta_i[i_theta] - grid.radial[j];
      const double from_normal = grid.theta_i[i_theta] + grid.radial[j];
      const bool has_near = profile.reaches(to_normal), has_far = profile.reaches(from_normal);
      f_r.row(grid.row(i_rotation, i_theta, 0, j)) =
          profile.at(has_near || !has_far ? to_normal : from_normal).transpose();
      f_r.row(grid.row(i_rotation, i_theta, 1, j)) =
          profile.at(has_far || !has_near ? from_normal : to_normal).transpose();
    }
  }
  return std::make_unique<SpecularTable>(channels, std::move(grid), std::move(f_r));
}

/// Points anywhere: neighbours by half vector and incidence, weighted by the inverse square of
/// their distance.
class ScatteredBrdf : public MeasuredBrdf {
 public:
  ScatteredBrdf(const BrdfPoints& points, std::vector<BrdfChannel> channels)
      : channels_(std::move(channels)),
        is_mirrored_(points.is_mirrored),
        is_isotropic_(points.is_isotropic),
        largest_theta_(points.theta_i.maxCoeff()),
        f_r_(points.f_r),
        places_(places_of(points)) {}

  [[nodiscard]] const std::vector<BrdfChannel>& channels() const override { return channels_; }

  void evaluate(const Vector3& omega_i, const DirectionBatch& omega_r,
                Eigen::Ref<Eigen::ArrayXXd> f_r) const override {
    f_r.setZero();
    if (omega_i.z() <= 0.0) {
      return;
    }
    const IncidenceFrame frame(omega_i);
    std::vector<std::pair<double, Index>> nearest;
    for (Index i = 0; i < omega_r.size(); ++i) {
      if (omega_r.z[i] <= 0.0) {
        continue;
      }
      const Vector3 local = frame.local(omega_r.x[i], omega_r.y[i], omega_r.z[i]);
      places_.find(place(frame.theta_i(), frame.rotation(), local), neighbours, nearest);
      double sum = 0.0;
      for (const auto& [square, row] : nearest) {
        const double weight = 1.0 / (square + exact);
        f_r.row(i) += weight * f_r_.row(row);
        sum += weight;
      }
      f_r.row(i) /= sum;
    }
  }

  [[nodiscard]] Angle step(Angle theta_i) const override {
    std::vector<std::pair<double, Index>> nearest;
    places_.find(place(theta_i.radians(), 0.0, mirrored(local_incidence(theta_i.radians()))),
                 neighbours, nearest);
    return radians(2.0 * std::sqrt(nearest.back().first));  // half vectors move half as far
  }

  [[nodiscard]] Angle largest_theta() const override { return radians(largest_theta_); }

 private:
  static constexpr std::size_t neighbours = 6;
  static constexpr double exact = 1e-12;  // so that a point gives its own value

  [[nodiscard]] Eigen::ArrayXd place(double theta_i, double rotation, const Vector3& local) const {
    const Vector3 half = (local_incidence(theta_i) + local).normalized();
    const double sin_i = is_isotropic_ ? 0.0 : std::sin(theta_i);
    Eigen::ArrayXd result(6);
    result << half.x(), is_mirrored_ ? std::abs(half.y()) : half.y(), half.z(), theta_i,
        sin_i * std::cos(rotation), sin_i * std::sin(rotation);
    return result;
  }

  [[nodiscard]] Eigen::ArrayXXd places_of(const BrdfPoints& points) const {
    Eigen::ArrayXXd places(points.size(), 6);
    for (Index i = 0; i < points.size(); ++i) {
      const double sin_r = std::sin(points.theta_r[i]);
      const Vector3 local(sin_r * std::cos(points.azimuth[i]), sin_r * std::sin(points.azimuth[i]),
                          std::cos(points.theta_r[i]));
      places.row(i) = place(points.theta_i[i], points.rotation[i], local).transpose();
    }
    return places;
  }

  std::vector<BrdfChannel> channels_;
  bool is_mirrored_, is_isotropic_;
  double largest_theta_;
  Eigen::ArrayXXd f_r_;
  NearestPoints places_;
};

}  // namespace

std::unique_ptr<const MeasuredBrdf> make_brdf_interpolation(
    const BrdfPoints& points, const std::vector<BrdfChannel>& channels,
    std::vector<std::string>& warnings) {
  if (points.is_in_plane()) {
    if (auto table = table_of_profiles(points, channels)) {
      warnings.push_back(
          "measured in the plane of incidence only: filled in round the mirror direction");
      return table;
    }
  }
  BrdfSlice::Report report;
  if (auto sliced = SlicedBrdf::of(points, channels, report)) {
    if (report.doubled > 0) {
      warnings.push_back(fmt::format("{} of {} samples were measured before: their mean stands",
                                     report.doubled, points.size()));
    }
    if (report.holes > 0) {
      warnings.push_back(fmt::format(
          "{} directions of the grid were not measured: filled in from those next to them",
          report.holes));
    }
    return sliced;
  }
  warnings.push_back("directions are on no grid: the nearest ones are weighted by their distance");
  return std::make_unique<ScatteredBrdf>(points, channels);
}

}  // namespace gonio
