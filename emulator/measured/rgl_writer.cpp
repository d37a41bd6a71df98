#include "emulator/measured/rgl_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <ostream>
#include <span>
#include <stdexcept>

#include "emulator/core/parallel_for.hpp"
#include "emulator/core/text_file.hpp"
#include "emulator/measured/half_vector_warp.hpp"
#include "emulator/measured/tensor_file.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;
using std::numbers::pi;

/// Reflectances bend more towards grazing incidence.
constexpr double step_deg = 5.0;
constexpr double fine_step_deg = 2.5;
constexpr double fine_from_deg = 45.0;
/// A BRDF is nothing at 90 deg itself.
constexpr double largest_theta_deg = 89.9;
constexpr std::size_t warp_nodes = 257;
/// The lobe falls over few of them: 26 up to an rms slope of 0.02.
constexpr std::size_t lobe_nodes = 1025;
/// Below this part of the peak, a lobe is nothing that the grid should follow.
constexpr double least_lobe = 1e-4;
/// Half directions further than this lead below the surface when light comes from the normal.
constexpr double widest_half_angle = pi / 4.0 - 0.02;
constexpr float whole_area = 0.25F;  ///< sigma, so that 4 sigma = 1
constexpr int azimuths_of_lobe = 8;

Vector3 spherical(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// Half directions of the unit square: theta = (pi/2) x^2, phi = pi (2 y - 1).
Vector3 half_direction(double x, double y) {
  return spherical(pi / 2.0 * x * x, pi * (2.0 * y - 1.0));
}

double unit_node(std::size_t i, std::size_t n) { return double(i) / double(n - 1); }

/// Where half directions mirror the light to. Below the surface f_r is that of the direction as far
/// above it, so that f_r cos(theta_r) is smooth where it passes 0.
struct Mirrored {
  ArrayXXd f_r;    ///< in all channels of the source
  ArrayXd cosine;  ///< of theta_r; 0 where the light comes from behind the half direction
};

Mirrored mirrored_by(const std::vector<Vector3>& half, const MeasuredBrdf& source,
                     const Vector3& omega_i) {
  const auto n = Index(half.size());
  DirectionBatch omega_r;
  omega_r.resize(n);
  Mirrored result{ArrayXXd(n, Index(source.channels().size())), ArrayXd(n)};
  for (Index j = 0; j < n; ++j) {
    const Vector3& m = half[std::size_t(j)];
    const double cos_d = m.dot(omega_i);
    const Vector3 r = 2.0 * cos_d * m - omega_i;
    omega_r.x(j) = r.x();
    omega_r.y(j) = r.y();
    omega_r.z(j) = std::abs(r.z());
    result.cosine(j) = cos_d > 0.0 ? r.z() : 0.0;
  }
  source.evaluate(omega_i, omega_r, result.f_r);
  return result;
}

/// How the channels of a source become those of a file: shape (file, source).
struct ChannelMap {
  Eigen::MatrixXd matrix;
  std::vector<float> wavelengths_nm;  ///< empty for RGB
};

ChannelMap channel_map(const std::vector<BrdfChannel>& channels) {
  using Band = BrdfChannel::Band;
  const auto are = [&](std::initializer_list<Band> bands) {
    return std::ranges::equal(channels, bands, {}, &BrdfChannel::band);
  };
  if (are({Band::red, Band::green, Band::blue})) {
    return {Eigen::Matrix3d::Identity(), {}};
  }
  if (are({Band::x, Band::y, Band::z})) {
    Eigen::Matrix3d rgb;
    rgb << 3.2406, -1.5372, -0.4986, -0.9689, 1.8758, 0.0415, 0.0557, -0.2040, 1.0570;
    return {rgb, {}};
  }
  if (are({Band::luminance})) {
    return {Eigen::Vector3d::Ones(), {}};
  }
  ChannelMap map{Eigen::MatrixXd::Identity(Index(channels.size()), Index(channels.size())), {}};
  for (const BrdfChannel& channel : channels) {
    if (channel.band != Band::wavelength) {
      throw std::invalid_argument(
          fmt::format("RGL file: expected R, G, B or X, Y, Z or Luminance or wavelengths, found {}",
                      channel_name(channel)));
    }
    map.wavelengths_nm.push_back(float(channel.wavelength.value().nanometres()));
  }
  return map;
}

std::vector<double> polar_angles(const MeasuredBrdf& source, const std::vector<Angle>& wanted) {
  std::vector<double> theta_i;
  for (const Angle theta : wanted) {
    theta_i.push_back(theta.radians());
  }
  if (wanted.empty()) {
    const double last_deg = std::min(source.largest_theta().degrees(), largest_theta_deg);
    for (double deg = 0.0; deg < last_deg - 0.5 * fine_step_deg;
         deg += deg < fine_from_deg ? step_deg : fine_step_deg) {
      theta_i.push_back(degrees(deg).radians());
    }
    theta_i.push_back(degrees(last_deg).radians());
  }
  const bool ascend = std::ranges::adjacent_find(theta_i, std::greater_equal{}) == theta_i.end();
  if (!ascend || theta_i.front() != 0.0 || theta_i.back() > pi / 2.0) {
    throw std::invalid_argument("RGL file: theta_i must ascend from 0 deg to at most 90 deg");
  }
  return theta_i;
}

std::vector<double> azimuths(const std::vector<Angle>& wanted) {
  if (wanted.empty()) {
    return {0.0};
  }
  std::vector<double> phi_i;
  for (const Angle phi : wanted) {
    phi_i.push_back(phi.radians());
  }
  constexpr double rounding = 1e-6;
  const bool ascend = std::ranges::adjacent_find(phi_i, std::greater_equal{}) == phi_i.end();
  if (!ascend || phi_i.size() < 3 || std::abs(phi_i.front() + pi) > rounding ||
      std::abs(phi_i.back() - pi) > rounding) {
    throw std::invalid_argument("RGL file: phi_i must ascend from -180 deg to 180 deg");
  }
  return phi_i;
}

/// Half directions along x, at some azimuths.
std::vector<Vector3> half_profile(std::size_t n, double y) {
  std::vector<Vector3> half;
  for (std::size_t i = 0; i < n; ++i) {
    half.push_back(half_direction(unit_node(i, n), y));
  }
  return half;
}

/// Light and dark as one number.
ArrayXd mean_of(const ArrayXXd& values) { return values.rowwise().mean(); }

/// The shape of the lobe as light from the normal shows it. What is stored is divided by it, so
/// that a narrow lobe leaves little to interpolate.
ArrayXd lobe_shape(const MeasuredBrdf& source) {
  ArrayXd lobe = ArrayXd::Zero(Index(lobe_nodes));
  for (int a = 0; a < azimuths_of_lobe; ++a) {
    const std::vector<Vector3> half = half_profile(lobe_nodes, double(a) / azimuths_of_lobe);
    lobe += mean_of(mirrored_by(half, source, Vector3::UnitZ()).f_r);
  }
  const auto end = Index(std::sqrt(widest_half_angle * 2.0 / pi) * double(lobe_nodes - 1));
  lobe.tail(lobe.size() - end - 1).setConstant(lobe(end));
  const double peak = lobe.maxCoeff();
  return peak > 0.0 ? ArrayXd((lobe / peak).max(least_lobe)) : ArrayXd::Ones(lobe.size());
}

double interpolated(const ArrayXd& nodes, double x) {
  const double at = x * double(nodes.size() - 1);
  const Index i = std::min(Index(at), nodes.size() - 2);
  return nodes(i) + (at - double(i)) * (nodes(i + 1) - nodes(i));
}

/// Where the grid is dense along x: half of it evenly, half where the logarithm of the BRDF
/// changes.
ArrayXd mesh_density(const MeasuredBrdf& source, const std::vector<double>& theta_i) {
  ArrayXd change = ArrayXd::Zero(Index(warp_nodes));
  const Index inner = change.size() - 1;
  for (const double theta : theta_i) {
    const Vector3 omega_i = spherical(std::min(theta, degrees(largest_theta_deg).radians()), pi);
    for (const double y : {0.0, 0.25, 0.5}) {
      const ArrayXd f = mean_of(mirrored_by(half_profile(warp_nodes, y), source, omega_i).f_r);
      const ArrayXd log_f = (f + 1e-300 + 10.0 * least_lobe * f.maxCoeff()).log();
      const ArrayXd steps = (log_f.tail(inner) - log_f.head(inner)).abs();
      change.head(inner) += 0.5 * steps;
      change.tail(inner) += 0.5 * steps;
    }
  }
  const double mean = change.mean();
  return mean > 0.0 ? ArrayXd(1.0 + change / mean) : ArrayXd::Ones(change.size());
}

/// Both rows of a warp that does not depend on y.
std::vector<float> warp_table(const ArrayXd& density) {
  std::vector<float> table;
  for (int row = 0; row < 2; ++row) {
    for (const double value : density) {
      table.push_back(float(value));
    }
  }
  return table;
}

/// The x of n nodes that a reader finds at equal steps behind the warp.
std::vector<double> mesh_nodes(const ArrayXd& density, std::size_t n) {
  const HalfVectorWarp warp({2, warp_nodes}, warp_table(density));
  const TableBlend blend{.count = 1, .table = {0}, .weight = {1.0F}};
  std::vector<double> nodes;
  for (std::size_t i = 0; i < n; ++i) {
    double below = 0.0;
    double above = i == 0 ? 0.0 : 1.0;
    for (int halving = 0; halving < 30 && i + 1 < n; ++halving) {
      const double x = 0.5 * (below + above);
      (double(warp.invert(blend, float(x), 0.5F).first) < unit_node(i, n) ? below : above) = x;
    }
    nodes.push_back(i + 1 < n ? 0.5 * (below + above) : 1.0);
  }
  return nodes;
}

/// All of a file that depends on directions.
class RglTablesOf {
 public:
  RglTablesOf(const MeasuredBrdf& source, const RglOptions& options)
      : source_(source),
        map_(channel_map(source.channels())),
        theta_i_(polar_angles(source, options.theta_i)),
        phi_i_(azimuths(options.phi_i)),
        n_(std::size_t(options.size)),
        lobe_(lobe_shape(source)),
        density_(mesh_density(source, theta_i_)),
        x_(mesh_nodes(density_, n_)),
        values_(tables() * channels() * n_ * n_),
        luminance_(tables() * n_ * n_) {
    for (std::size_t row = 0; row < n_; ++row) {
      for (const double x : x_) {
        half_.push_back(half_direction(x, unit_node(row, n_)));
      }
    }
    parallel_for(tables(), [this](std::size_t table) { fill(table); });
  }

  [[nodiscard]] std::vector<TensorOutput> fields(const std::string& description) const;

 private:
  [[nodiscard]] std::size_t tables() const { return phi_i_.size() * theta_i_.size(); }
  [[nodiscard]] std::size_t channels() const { return std::size_t(map_.matrix.rows()); }
  void fill(std::size_t table);
  void fill_luminance(std::size_t table, const Vector3& omega_i, const ArrayXd& mean);

  const MeasuredBrdf& source_;
  ChannelMap map_;
  std::vector<double> theta_i_, phi_i_;
  std::size_t n_;
  ArrayXd lobe_, density_;
  std::vector<double> x_;
  std::vector<Vector3> half_;
  std::vector<float> values_, luminance_;
};

void RglTablesOf::fill(std::size_t table) {
  const double theta =
      std::min(theta_i_[table % theta_i_.size()], degrees(largest_theta_deg).radians());
  const Vector3 omega_i = spherical(theta, phi_i_[table / theta_i_.size()]);
  const Mirrored mirrored = mirrored_by(half_, source_, omega_i);
  const ArrayXXd f = mirrored.f_r.colwise() * mirrored.cosine;
  const ArrayXXd g = (f.matrix() * map_.matrix.transpose()).array();
  for (std::size_t c = 0; c < channels(); ++c) {
    float* const plane = values_.data() + (table * channels() + c) * n_ * n_;
    for (std::size_t node = 0; node < n_ * n_; ++node) {
      plane[node] = float(g(Index(node), Index(c)) / interpolated(lobe_, x_[node % n_]));
    }
  }
  fill_luminance(table, omega_i, mean_of(f));
}

/// What the RGL's reader draws directions by: as much light as goes to each cell of the grid.
void RglTablesOf::fill_luminance(std::size_t table, const Vector3& omega_i, const ArrayXd& mean) {
  constexpr double least = 1e-6;
  ArrayXd light(mean.size());
  for (Index node = 0; node < mean.size(); ++node) {
    const double x = x_[std::size_t(node) % n_];
    const Vector3& m = half_[std::size_t(node)];
    const double solid_angle = std::hypot(m.x(), m.y()) * x * std::max(m.dot(omega_i), 0.0);
    light(node) = std::max(mean(node), 0.0) * solid_angle / interpolated(density_, x);
  }
  const double peak = light.maxCoeff();
  for (Index node = 0; node < light.size(); ++node) {
    luminance_[table * n_ * n_ + std::size_t(node)] =
        peak > 0.0 ? float(light(node) / peak + least) : 1.0F;
  }
}

std::vector<float> as_floats(std::span<const double> values) {
  std::vector<float> result;
  for (const double value : values) {
    result.push_back(float(value));
  }
  return result;
}

std::vector<TensorOutput> RglTablesOf::fields(const std::string& description) const {
  const std::size_t n_phi = phi_i_.size();
  const std::size_t n_theta = theta_i_.size();
  std::vector<float> warps;
  for (std::size_t table = 0; table < tables(); ++table) {
    const std::vector<float> warp = warp_table(density_);
    warps.insert(warps.end(), warp.begin(), warp.end());
  }
  const std::vector<float> lobe = as_floats({lobe_.data(), lobe_nodes});
  std::vector<float> lobes = lobe;
  lobes.insert(lobes.end(), lobe.begin(), lobe.end());
  const std::string text = description.empty() ? "BRDF" : description;
  const std::vector<float> sigma(4, whole_area);
  std::vector<TensorOutput> fields{
      {"version", TensorType::u32, {2}, std::string("\1\0\0\0\0\0\0\0", 8)},
      {"description", TensorType::u8, {text.size()}, text},
      tensor_output("phi_i", {n_phi}, as_floats(phi_i_)),
      tensor_output("theta_i", {n_theta}, as_floats(theta_i_)),
      tensor_output("sigma", {2, 2}, sigma),
      tensor_output("ndf", {2, lobe_nodes}, lobes),
      tensor_output("vndf", {n_phi, n_theta, 2, warp_nodes}, warps),
      tensor_output("luminance", {n_phi, n_theta, n_, n_}, luminance_)};
  const bool is_spectral = !map_.wavelengths_nm.empty();
  if (is_spectral) {
    fields.push_back(tensor_output("wavelengths", {channels()}, map_.wavelengths_nm));
  }
  fields.push_back(tensor_output(is_spectral ? "spectra" : "rgb",
                                 {n_phi, n_theta, channels(), n_, n_}, values_));
  fields.push_back({"jacobian", TensorType::u8, {1}, "\1"});
  fields.push_back({"valid", TensorType::u8, {n_ * n_}, std::string(n_ * n_, '\1')});
  return fields;
}

}  // namespace

void write_rgl(const std::filesystem::path& path, const MeasuredBrdf& source,
               const RglOptions& options) {
  if (options.size < 8 || options.size > 1024) {
    throw std::invalid_argument(
        fmt::format("RGL file: expected a grid of 8 to 1024, found {}", options.size));
  }
  const std::vector<TensorOutput> fields = RglTablesOf(source, options).fields(options.description);
  write_file(path, [&](std::ostream& out) { write_tensors(out, fields); });
}

}  // namespace gonio
