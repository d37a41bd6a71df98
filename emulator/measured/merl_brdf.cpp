#include "emulator/measured/merl_brdf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "emulator/measured/binary_file.hpp"

namespace gonio {

namespace {

using std::numbers::pi;

constexpr std::size_t n_channels = 3;
constexpr std::size_t head_size = 3 * sizeof(std::int32_t);
/// What a number of the file is multiplied with, for [1/sr], in R, G, B.
constexpr std::array<double, n_channels> scale{1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};
constexpr std::int32_t largest_count = 10000;  // so that their product is a size
constexpr float not_measured = -1.0F;
/// No material reflects that much; it keeps numbers within those of a float.
constexpr double largest_f_r = 1e12;

struct Counts {
  std::size_t theta_h, theta_d, phi_d;
  [[nodiscard]] std::size_t nodes() const { return theta_h * theta_d * phi_d; }
};
constexpr std::array<std::int32_t, 3> counts_of_merl{90, 90, 180};

/// Where a coordinate lies between nodes: at `below`, by `part` on to `above`.
struct Place {
  std::size_t below, above;
  float part;
};

/// @param t  in steps of the grid; beyond its last node, that.
Place place(double t, std::size_t n) {
  const std::size_t below = std::min(std::size_t(t), n - 1);
  const std::size_t above = std::min(below + 1, n - 1);
  return {below, above, above == below ? 0.0F : float(t - double(below))};
}

/// Rusinkiewicz' angles. Node k of theta_h stands at (pi/2) (k/n)^2, of theta_d at (pi/2) k/n, and
/// of phi_d at pi k/n; phi_d + pi is the same as phi_d, by reciprocity.
class MerlBrdf final : public MeasuredBrdf {
 public:
  /// @param f_r  [1/sr], shape (theta_h, theta_d, phi_d, channel).
  MerlBrdf(Counts counts, std::vector<float> f_r) : counts_(counts), f_r_(std::move(f_r)) {}

  [[nodiscard]] const std::vector<BrdfChannel>& channels() const override { return channels_; }
  void evaluate(const Vector3& omega_i, const DirectionBatch& omega_r,
                Eigen::Ref<Eigen::ArrayXXd> f_r) const override;
  [[nodiscard]] Angle step(Angle theta_i) const override;
  [[nodiscard]] Angle largest_theta() const override {
    return degrees(90.0 * (1.0 - 1.0 / double(counts_.theta_d)));
  }

 private:
  using Rgb = std::array<float, n_channels>;
  [[nodiscard]] Place place_of_theta_h(double theta_h) const;
  [[nodiscard]] Rgb at(const Vector3& omega_i, const Vector3& omega_r) const;
  void add(Rgb& sum, float weight, std::size_t theta_h, std::size_t theta_d,
           const Place& phi_d) const;

  Counts counts_;
  std::vector<float> f_r_;
  std::vector<BrdfChannel> channels_{{.band = BrdfChannel::Band::red},
                                     {.band = BrdfChannel::Band::green},
                                     {.band = BrdfChannel::Band::blue}};
};

Place MerlBrdf::place_of_theta_h(double theta_h) const {
  const double t = theta_h / (pi / 2.0);
  const auto n = double(counts_.theta_h);
  Place result = place(n * std::sqrt(t), counts_.theta_h);
  if (result.above > result.below) {  // linear in the angle, not in its root
    const auto k = double(result.below);
    result.part = float(std::clamp((t * n * n - k * k) / (2.0 * k + 1.0), 0.0, 1.0));
  }
  return result;
}

void MerlBrdf::add(Rgb& sum, float weight, std::size_t theta_h, std::size_t theta_d,
                   const Place& phi_d) const {
  const std::size_t first = (theta_h * counts_.theta_d + theta_d) * counts_.phi_d;
  const float* const below = f_r_.data() + (first + phi_d.below) * n_channels;
  const float* const above = f_r_.data() + (first + phi_d.above) * n_channels;
  for (std::size_t c = 0; c < n_channels; ++c) {
    sum[c] += weight * ((1.0F - phi_d.part) * below[c] + phi_d.part * above[c]);
  }
}

MerlBrdf::Rgb MerlBrdf::at(const Vector3& omega_i, const Vector3& omega_r) const {
  const Vector3 sum = omega_i + omega_r;
  const Vector3 difference = omega_i - omega_r;
  const double across = std::hypot(sum.x(), sum.y());
  const Place theta_h = place_of_theta_h(std::atan2(across, sum.z()));
  const double t_d = std::atan2(difference.norm(), sum.norm()) / (pi / 2.0);
  const Place theta_d = place(t_d * double(counts_.theta_d), counts_.theta_d);
  // The difference is square to the half direction. The axes there are e_theta and e_phi of it.
  const double cos_phi = across > 0.0 ? sum.x() / across : 1.0;
  const double sin_phi = across > 0.0 ? sum.y() / across : 0.0;
  const double along_phi = cos_phi * difference.y() - sin_phi * difference.x();
  const double along_theta =
      ((cos_phi * difference.x() + sin_phi * difference.y()) * sum.z() - difference.z() * across) /
      sum.norm();
  double t_phi = std::atan2(along_phi, along_theta) / pi;
  t_phi -= std::floor(t_phi);
  Place phi_d = place(t_phi * double(counts_.phi_d), counts_.phi_d);
  if (phi_d.above == phi_d.below) {
    phi_d.above = 0;
    phi_d.part = float(t_phi * double(counts_.phi_d) - double(phi_d.below));
  }
  Rgb result{};
  add(result, (1.0F - theta_h.part) * (1.0F - theta_d.part), theta_h.below, theta_d.below, phi_d);
  add(result, (1.0F - theta_h.part) * theta_d.part, theta_h.below, theta_d.above, phi_d);
  add(result, theta_h.part * (1.0F - theta_d.part), theta_h.above, theta_d.below, phi_d);
  add(result, theta_h.part * theta_d.part, theta_h.above, theta_d.above, phi_d);
  return result;
}

void MerlBrdf::evaluate(const Vector3& omega_i, const DirectionBatch& omega_r,
                        Eigen::Ref<Eigen::ArrayXXd> f_r) const {
  f_r.setZero();
  if (!(omega_i.z() > 0.0)) {
    return;
  }
  for (Eigen::Index j = 0; j < omega_r.size(); ++j) {
    if (!(omega_r.z(j) > 0.0)) {
      continue;
    }
    const Rgb values = at(omega_i, {omega_r.x(j), omega_r.y(j), omega_r.z(j)});
    for (std::size_t c = 0; c < n_channels; ++c) {
      f_r(j, Eigen::Index(c)) = double(values[c]);
    }
  }
}

/// Nodes of theta_h crowd at 0, closer than the camera could tell; its own pixels, 1 deg of theta_d
/// wide, say nothing of the lobe. So this is the step of the table, twice that of theta_h.
Angle MerlBrdf::step(Angle /*theta_i*/) const {
  const auto n = double(counts_.theta_h);
  return degrees(2.0 * 90.0 / (n * n));
}

std::array<std::int32_t, 3> counts_in(std::span<const std::byte> head) {
  std::array<std::int32_t, 3> counts{};
  std::memcpy(counts.data(), head.data(), head_size);
  return counts;
}

/// The counts of a file; its size is held against them before anything is allocated.
Counts read_counts(const ByteReader& in) {
  constexpr std::array<const char*, 3> names{"number of theta_h", "number of theta_d",
                                             "number of phi_d"};
  constexpr std::size_t node_size = n_channels * sizeof(double);
  std::array<std::size_t, 3> counts{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t offset = i * sizeof(std::int32_t);
    const auto count = in.number<std::int32_t>(offset, names[i]);
    if (count < 1 || count > largest_count) {
      in.fail(offset, names[i], fmt::format("1 to {}", largest_count), fmt::format("{}", count));
    }
    counts[i] = std::size_t(count);
  }
  const Counts result{counts[0], counts[1], counts[2]};
  if (const std::size_t size = head_size + result.nodes() * node_size; size != in.size()) {
    in.fail(std::min(size, in.size()), "end of the file",
            fmt::format("{} bytes, for {} x {} x {} nodes", size, counts[0], counts[1], counts[2]),
            fmt::format("{} bytes", in.size()));
  }
  return result;
}

/// f_r [1/sr], shape (node, channel), from one plane of doubles per channel.
std::vector<float> read_values(const ByteReader& in, std::size_t n_nodes) {
  std::vector<float> f_r(n_nodes * n_channels);
  for (std::size_t c = 0; c < n_channels; ++c) {
    const std::size_t offset = head_size + c * n_nodes * sizeof(double);
    const std::byte* plane = in.bytes(offset, n_nodes * sizeof(double), "values").data();
    for (std::size_t node = 0; node < n_nodes; ++node) {
      double value = 0.0;
      std::memcpy(&value, plane + node * sizeof(double), sizeof value);
      value *= scale[c];
      if (!(std::abs(value) <= largest_f_r)) {
        in.fail(offset + node * sizeof(double), "value",
                fmt::format("a BRDF up to {} per sr", largest_f_r), fmt::format("{}", value));
      }
      f_r[node * n_channels + c] = value < 0.0 ? not_measured : float(value);
    }
  }
  return f_r;
}

/// The next number of the same channel, up and down each angle; phi_d goes round.
std::array<std::size_t, 6> neighbours(std::size_t at, const Counts& n) {
  const std::size_t node = at / n_channels;
  const std::size_t row = n.phi_d * n_channels;
  const std::size_t plane = n.theta_d * row;
  const std::size_t phi_d = node % n.phi_d;
  const std::size_t theta_d = node / n.phi_d % n.theta_d;
  const std::size_t theta_h = node / n.phi_d / n.theta_d;
  const std::size_t first = at - phi_d * n_channels;
  return {first + (phi_d + 1) % n.phi_d * n_channels,
          first + (phi_d + n.phi_d - 1) % n.phi_d * n_channels,
          theta_d + 1 < n.theta_d ? at + row : at,
          theta_d > 0 ? at - row : at,
          theta_h + 1 < n.theta_h ? at + plane : at,
          theta_h > 0 ? at - plane : at};
}

/// Fills what was not measured with the mean of its neighbours, from the edges of a gap inwards.
/// @return  how many there were.
std::size_t fill_gaps(std::vector<float>& f_r, const Counts& counts) {
  std::vector<std::size_t> gaps;
  for (std::size_t i = 0; i < f_r.size(); ++i) {
    if (f_r[i] < 0.0F) {
      gaps.push_back(i);
    }
  }
  std::vector<std::size_t> edge;
  const auto is_at_edge = [&](std::size_t i) {
    return std::ranges::any_of(neighbours(i, counts), [&](std::size_t j) { return f_r[j] >= 0; });
  };
  std::ranges::copy_if(gaps, std::back_inserter(edge), is_at_edge);
  std::vector<float> means;
  while (!edge.empty()) {
    means.clear();
    for (const std::size_t i : edge) {
      float sum = 0.0F;
      int n = 0;
      for (const std::size_t j : neighbours(i, counts)) {
        sum += f_r[j] >= 0.0F ? f_r[j] : 0.0F;
        n += f_r[j] >= 0.0F ? 1 : 0;
      }
      means.push_back(sum / float(n));
    }
    for (std::size_t k = 0; k < edge.size(); ++k) {
      f_r[edge[k]] = means[k];
    }
    std::vector<std::size_t> next;
    for (const std::size_t i : edge) {
      std::ranges::copy_if(neighbours(i, counts), std::back_inserter(next),
                           [&](std::size_t j) { return f_r[j] < 0.0F; });
    }
    std::ranges::sort(next);
    next.erase(std::unique(next.begin(), next.end()), next.end());
    edge = std::move(next);
  }
  return gaps.size();
}

}  // namespace

bool is_merl(std::span<const std::byte> head, std::uintmax_t file_size) {
  if (head.size() < head_size) {
    return false;
  }
  const auto counts = counts_in(head);
  if (counts == counts_of_merl) {
    return true;
  }
  std::uintmax_t nodes = 1;
  for (const std::int32_t count : counts) {
    if (count < 1 || std::uintmax_t(count) > file_size / nodes) {
      return false;
    }
    nodes *= std::uintmax_t(count);
  }
  return nodes <= file_size / (n_channels * sizeof(double)) &&
         head_size + nodes * n_channels * sizeof(double) == file_size;
}

BrdfFile parse_merl(std::span<const std::byte> bytes, const std::string& file) {
  const ByteReader in(bytes, file);
  const Counts counts = read_counts(in);
  std::vector<float> f_r = read_values(in, counts.nodes());
  for (std::size_t c = 0; c < n_channels; ++c) {
    bool any = false;
    for (std::size_t i = c; i < f_r.size() && !any; i += n_channels) {
      any = f_r[i] >= 0.0F;
    }
    if (!any) {
      in.fail(head_size + c * counts.nodes() * sizeof(double), "values",
              "at least one that is not negative", "none");
    }
  }
  BrdfFile result{.file = file, .format = BrdfFormat::merl, .brdf = nullptr};
  if (const std::size_t gaps = fill_gaps(f_r, counts); gaps > 0) {
    result.warnings.push_back(
        fmt::format("{} of {} numbers are negative, which means not measured: filled in from "
                    "their neighbours",
                    gaps, f_r.size()));
  }
  result.brdf = std::make_shared<MerlBrdf>(counts, std::move(f_r));
  return result;
}

BrdfFile read_merl(const std::filesystem::path& path) {
  const BinaryFile file(path);
  return parse_merl(file.bytes(), path.string());
}

}  // namespace gonio
