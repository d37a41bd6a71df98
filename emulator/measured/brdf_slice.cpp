#include "emulator/measured/brdf_slice.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "emulator/measured/bracket.hpp"
#include "emulator/measured/nearest_points.hpp"

namespace gonio {

using Eigen::Index;

std::optional<BrdfSlice> BrdfSlice::on_grid(const BrdfPoints& points,
                                            const std::vector<Index>& rows, Report& report) {
  BrdfSlice slice;
  slice.is_mirrored_ = points.is_mirrored;
  std::vector<double> thetas, azimuths;
  for (const Index row : rows) {
    thetas.push_back(points.theta_r[row]);
    if (points.theta_r[row] > same_angle) {  // the normal has any azimuth
      azimuths.push_back(in_one_turn(points.azimuth[row]));
    }
  }
  if (azimuths.empty()) {
    azimuths.push_back(0.0);
  }
  slice.theta_ = distinct_angles(thetas);
  slice.azimuth_ = distinct_angles(azimuths);
  const double cells = double(slice.theta_.size()) * double(slice.azimuth_.size());
  if (cells > 2.0 * double(rows.size()) + double(slice.azimuth_.size())) {
    return std::nullopt;
  }
  slice.root_.setZero(points.f_r.cols(), Index(cells));
  std::vector<int> counts(std::size_t(cells), 0);
  const auto put = [&](Index cell, Index row) {
    slice.root_.col(cell) += points.f_r.row(row).transpose();
    ++counts[std::size_t(cell)];
  };
  for (const Index row : rows) {
    const Index i_theta = index_of_angle(slice.theta_, points.theta_r[row]);
    if (points.theta_r[row] <= same_angle) {
      for (Index i_azimuth = 0; i_azimuth < slice.azimuth_.size(); ++i_azimuth) {
        put(slice.cell(i_theta, i_azimuth), row);
      }
      continue;
    }
    const Index i_azimuth = index_of_angle(slice.azimuth_, in_one_turn(points.azimuth[row]));
    const Index cell = slice.cell(i_theta, i_azimuth);
    report.doubled += counts[std::size_t(cell)] > 0 ? 1 : 0;
    put(cell, row);
  }
  for (std::size_t i = 0; i < counts.size(); ++i) {
    slice.root_.col(Index(i)) /= std::max(counts[i], 1);
  }
  slice.root_ = slice.root_.sqrt().sqrt().eval();
  report.holes += std::ranges::count(counts, 0);
  slice.fill_holes(counts);
  return slice;
}

Vector3 BrdfSlice::direction_of(Index i_theta, Index i_azimuth) const {
  const double theta = theta_[i_theta], azimuth = azimuth_[i_azimuth];
  return {std::sin(theta) * std::cos(azimuth), std::sin(theta) * std::sin(azimuth),
          std::cos(theta)};
}

void BrdfSlice::fill_holes(const std::vector<int>& counts) {
  const Index known = Index(counts.size()) - std::ranges::count(counts, 0);
  if (known == Index(counts.size())) {
    return;
  }
  Eigen::ArrayXXd places(known, 3);
  std::vector<Index> cells;
  for (Index i = 0; i < theta_.size() * azimuth_.size(); ++i) {
    if (counts[std::size_t(i)] > 0) {
      places.row(Index(cells.size())) =
          direction_of(i / azimuth_.size(), i % azimuth_.size()).transpose().array();
      cells.push_back(i);
    }
  }
  const NearestPoints measured(places);
  std::vector<std::pair<double, Index>> nearest;
  for (Index i = 0; i < theta_.size() * azimuth_.size(); ++i) {
    if (counts[std::size_t(i)] == 0) {
      measured.find(direction_of(i / azimuth_.size(), i % azimuth_.size()).array(), 4, nearest);
      double sum = 0.0;
      for (const auto& [square, row] : nearest) {
        root_.col(i) += root_.col(cells[std::size_t(row)]) / std::max(square, 1e-12);
        sum += 1.0 / std::max(square, 1e-12);
      }
      root_.col(i) /= sum;
    }
  }
}

void BrdfSlice::add(const Vector3& local, double weight, Eigen::Ref<Eigen::ArrayXd> root) const {
  const Bracket theta = bracket(theta_, std::atan2(std::hypot(local.x(), local.y()), local.z()));
  const double angle = std::atan2(local.y(), local.x());
  const Bracket azimuth = is_mirrored_ ? bracket(azimuth_, std::abs(angle))
                                       : bracket_on_circle(azimuth_, in_one_turn(angle));
  const double first = weight * (1.0 - theta.weight), second = weight * theta.weight;
  root += first * (1.0 - azimuth.weight) * root_.col(cell(theta.first, azimuth.first)) +
          first * azimuth.weight * root_.col(cell(theta.first, azimuth.second)) +
          second * (1.0 - azimuth.weight) * root_.col(cell(theta.second, azimuth.first)) +
          second * azimuth.weight * root_.col(cell(theta.second, azimuth.second));
}

double BrdfSlice::step(double theta) const {
  constexpr double pi = std::numbers::pi;
  const Index n = theta_.size();
  double between = pi / 2.0;
  if (n > 1) {
    const Bracket here = bracket(theta_, theta);
    const Index low = std::max<Index>(here.nearest() - 1, 0);
    const Index high = std::min(here.nearest() + 1, n - 1);
    between = (theta_[high] - theta_[low]) / double(high - low);
  }
  const Index n_azimuth = azimuth_.size();
  const double round = n_azimuth < 2  ? 2.0 * pi
                       : is_mirrored_ ? azimuth_[1] - azimuth_[0]
                                      : std::min(azimuth_[1], 2.0 * pi - azimuth_[n_azimuth - 1]);
  return std::max(between, std::min(round * std::sin(theta), pi / 2.0));
}

}  // namespace gonio
