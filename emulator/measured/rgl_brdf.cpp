#include "emulator/measured/rgl_brdf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "emulator/measured/half_vector_warp.hpp"
#include "emulator/measured/tensor_file.hpp"

namespace gonio {

namespace {

using std::numbers::pi;

/// Some files were measured at all incidences, yet the light reaches the table edge-on at the last
/// ones: what the database's authors give for the goniophotometer.
constexpr double extrapolated_beyond_deg = 80.0;
constexpr double nearly_grazing_deg = 89.95;
/// No BRDF reaches that far; products of such numbers stay within those of a float.
constexpr TensorFile::Range any_number{-1e12F, 1e12F};
constexpr TensorFile::Range not_negative{0.0F, 1e12F};
/// Microfacets seen from a direction, per area of the surface: cos theta_i or more.
constexpr TensorFile::Range projected_area{1e-6F, 1e12F};
constexpr TensorFile::Range wavelengths_nm{1.0F, 1e6F};
/// pi/2 as a float is above pi/2.
constexpr TensorFile::Range upper_hemisphere{0.0F, float(pi / 2.0)};

/// A function on the unit square, bilinear between nodes.
struct UnitGrid {
  std::size_t rows, columns;
  std::vector<float> values;

  [[nodiscard]] double at(double x, double y) const {
    x *= double(columns - 1);
    y *= double(rows - 1);
    const std::size_t column = std::min(std::size_t(x), columns - 2);
    const std::size_t row = std::min(std::size_t(y), rows - 2);
    x -= double(column);
    y -= double(row);
    const float* const f = values.data() + row * columns + column;
    return (1.0 - y) * ((1.0 - x) * double(f[0]) + x * double(f[1])) +
           y * ((1.0 - x) * double(f[columns]) + x * double(f[columns + 1]));
  }
};

/// What a file holds.
struct RglTables {
  std::vector<float> phi_i, theta_i;  ///< [rad]
  int mirror_planes = 0;              ///< of anisotropic ones: 0, 1 or 2
  UnitGrid sigma, ndf;
  HalfVectorWarp warp;
  std::size_t rows, columns;  ///< of the values
  std::vector<float> values;  ///< shape (table, row, column, channel)
  std::vector<BrdfChannel> channels;
};

double unit_theta(double theta) { return std::min(std::sqrt(theta * (2.0 / pi)), 1.0); }
double unit_phi(double phi) {
  const double u = (phi + pi) / (2.0 * pi);
  return u - std::floor(u);
}
double polar_angle(double x, double y, double z) { return std::atan2(std::sqrt(x * x + y * y), z); }

class RglBrdf final : public MeasuredBrdf {
 public:
  explicit RglBrdf(RglTables tables) : tables_(std::move(tables)) {}

  [[nodiscard]] const std::vector<BrdfChannel>& channels() const override {
    return tables_.channels;
  }
  void evaluate(const Vector3& omega_i, const DirectionBatch& omega_r,
                Eigen::Ref<Eigen::ArrayXXd> f_r) const override;
  [[nodiscard]] Angle step(Angle theta_i) const override;
  [[nodiscard]] Angle largest_theta() const override {
    const double last_deg = double(tables_.theta_i.back()) * (180.0 / pi);
    return degrees(last_deg < nearly_grazing_deg ? last_deg : extrapolated_beyond_deg);
  }

 private:
  [[nodiscard]] bool is_isotropic() const { return tables_.phi_i.size() <= 2; }
  void interpolate(const TableBlend& blend, std::pair<float, float> sample,
                   std::vector<float>& values) const;

  RglTables tables_;
};

void RglBrdf::interpolate(const TableBlend& blend, std::pair<float, float> sample,
                          std::vector<float>& values) const {
  const float x = sample.first * float(tables_.columns - 1);
  const float y = sample.second * float(tables_.rows - 1);
  const std::size_t column = std::min(std::size_t(x), tables_.columns - 2);
  const std::size_t row = std::min(std::size_t(y), tables_.rows - 2);
  const float right = x - float(column);
  const float up = y - float(row);
  const std::size_t n = values.size();
  std::ranges::fill(values, 0.0F);
  for (std::size_t k = 0; k < std::size_t(blend.count); ++k) {
    const float lower = blend.weight[k] * (1.0F - up);
    const float upper = blend.weight[k] * up;
    const float* const f = tables_.values.data() +
                           ((blend.table[k] * tables_.rows + row) * tables_.columns + column) * n;
    const float* const g = f + tables_.columns * n;
    for (std::size_t c = 0; c < n; ++c) {
      values[c] += lower * ((1.0F - right) * f[c] + right * f[n + c]) +
                   upper * ((1.0F - right) * g[c] + right * g[n + c]);
    }
  }
}

void RglBrdf::evaluate(const Vector3& omega_i, const DirectionBatch& omega_r,
                       Eigen::Ref<Eigen::ArrayXXd> f_r) const {
  f_r.setZero();
  if (!(omega_i.z() > 0.0)) {
    return;
  }
  // Planes of mirror symmetry leave incidences with y <= 0, x <= 0 to the file.
  const double turn_y = tables_.mirror_planes >= 1 && omega_i.y() > 0.0 ? -1.0 : 1.0;
  const double turn_x = tables_.mirror_planes >= 2 && omega_i.x() > 0.0 ? -1.0 : 1.0;
  const Vector3 i(turn_x * omega_i.x(), turn_y * omega_i.y(), omega_i.z());
  const double theta_i = polar_angle(i.x(), i.y(), i.z());
  const double phi_i = std::atan2(i.y(), i.x());
  const TableBlend blend = table_blend(tables_.phi_i, tables_.theta_i, phi_i, theta_i);
  const double phi_0 = is_isotropic() ? phi_i : 0.0;
  const double scale = 0.25 / tables_.sigma.at(unit_theta(theta_i), unit_phi(phi_i));
  std::vector<float> values(tables_.channels.size());
  for (Eigen::Index j = 0; j < omega_r.size(); ++j) {
    const double z = omega_r.z(j);
    if (!(z > 0.0)) {
      continue;
    }
    const double m_x = i.x() + turn_x * omega_r.x(j);
    const double m_y = i.y() + turn_y * omega_r.y(j);
    const double x = unit_theta(polar_angle(m_x, m_y, i.z() + z));
    const double y = unit_phi(std::atan2(m_y, m_x) - phi_0);
    interpolate(blend, tables_.warp.invert(blend, float(x), float(y)), values);
    const double factor = scale * tables_.ndf.at(x, y) / z;
    for (std::size_t c = 0; c < values.size(); ++c) {
      f_r(j, Eigen::Index(c)) = factor * double(std::max(values[c], 0.0F));
    }
  }
}

/// The distribution of normals gives the lobe its shape; what its values are multiplied with varies
/// little over them. So the step is that of its table where it has fallen to half of its maximum.
Angle RglBrdf::step(Angle /*theta_i*/) const {
  const UnitGrid& ndf = tables_.ndf;
  const std::span<const float> row = std::span(ndf.values).first(ndf.columns);
  const float half = 0.5F * std::ranges::max(row);
  const auto peak = std::ranges::max_element(row);
  const auto fallen = std::find_if(peak, row.end(), [half](float d) { return d < half; });
  const double cell = 1.0 / double(ndf.columns - 1);
  const double x = std::max(double(fallen - row.begin()) * cell, cell);
  const double theta_step = (pi / 2.0) * (x * x - (x - cell) * (x - cell));
  // A mirror that turns by an angle turns light by twice that.
  return radians(std::min(2.0 * theta_step, pi / 2.0));
}

std::vector<float> ascending(const TensorFile& file, std::string_view name,
                             TensorFile::Range range) {
  std::vector<float> values = file.floats(name, {std::nullopt}, range);
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (!(values[i] > values[i - 1])) {
      file.fail(file.field(name, TensorType::f32, {std::nullopt}), i,
                fmt::format("more than {}", values[i - 1]), fmt::format("{}", values[i]));
    }
  }
  return values;
}

/// The two sizes of a grid, the last of a shape: 2 or more, since values are between nodes.
std::pair<std::size_t, std::size_t> grid_size(const TensorFile& file, std::string_view name,
                                              const TensorFile::Shape& shape) {
  const TensorFile::Field& field = file.field(name, TensorType::f32, shape);
  const std::size_t rows = field.shape[field.shape.size() - 2];
  const std::size_t columns = field.shape.back();
  if (rows < 2 || columns < 2) {
    file.fail(field, 0, "a grid of at least 2 x 2", fmt::format("{} x {}", rows, columns));
  }
  return {rows, columns};
}

UnitGrid unit_grid(const TensorFile& file, std::string_view name, TensorFile::Range range) {
  const TensorFile::Shape shape{std::nullopt, std::nullopt};
  const auto [rows, columns] = grid_size(file, name, shape);
  return {rows, columns, file.floats(name, shape, range)};
}

int mirror_planes(const TensorFile& file, const std::vector<float>& phi_i) {
  if (phi_i.size() <= 2) {
    return 0;
  }
  const double turn = double(phi_i.back()) - double(phi_i.front());
  const auto parts = std::lround(std::min(2.0 * pi / turn, 100.0));
  if (parts != 1 && parts != 2 && parts != 4) {
    file.fail(file.field("phi_i", TensorType::f32, {std::nullopt}), phi_i.size() - 1,
              "azimuths over a whole, a half or a quarter of a turn",
              fmt::format("{:.4g} of one", turn / (2.0 * pi)));
  }
  return parts == 4 ? 2 : int(parts) - 1;
}

HalfVectorWarp read_warp(const TensorFile& file, std::size_t n_phi, std::size_t n_theta) {
  const TensorFile::Shape shape{n_phi, n_theta, std::nullopt, std::nullopt};
  const auto [rows, columns] = grid_size(file, "vndf", shape);
  HalfVectorWarp warp({rows, columns}, file.floats("vndf", shape, not_negative));
  if (warp.empty_table() < warp.tables()) {
    file.fail(file.field("vndf", TensorType::f32, shape), warp.empty_table() * rows * columns,
              "a density that is not 0 everywhere", "0");
  }
  return warp;
}

std::vector<BrdfChannel> read_channels(const TensorFile& file) {
  using Band = BrdfChannel::Band;
  if (!file.has("spectra")) {
    return {{.band = Band::red}, {.band = Band::green}, {.band = Band::blue}};
  }
  std::vector<BrdfChannel> channels;
  for (const float wavelength_nm : ascending(file, "wavelengths", wavelengths_nm)) {
    channels.push_back({.band = Band::wavelength, .wavelength = nanometres(double(wavelength_nm))});
  }
  return channels;
}

/// From (table, channel, row, column), as in the file, to channels side by side.
std::vector<float> with_channels_last(const std::vector<float>& values, std::size_t n_channels,
                                      std::size_t n_nodes) {
  std::vector<float> result(values.size());
  const std::size_t n_tables = values.size() / (n_channels * n_nodes);
  for (std::size_t table = 0; table < n_tables; ++table) {
    const std::size_t first = table * n_channels * n_nodes;
    for (std::size_t c = 0; c < n_channels; ++c) {
      for (std::size_t node = 0; node < n_nodes; ++node) {
        result[first + node * n_channels + c] = values[first + c * n_nodes + node];
      }
    }
  }
  return result;
}

void check_kind(const TensorFile& file) {
  const auto& version = file.field("version", TensorType::u32, {2});
  if (const auto major = file.number<std::uint32_t>(version, 0); major != 1) {
    file.fail(version, 0, "1", fmt::format("{}", major));
  }
  const auto& jacobian = file.field("jacobian", TensorType::u8, {1});
  if (const int flag = file.number<std::uint8_t>(jacobian, 0); flag != 1) {
    file.fail(jacobian, 0, "1", fmt::format("{}", flag));
  }
}

}  // namespace

bool is_rgl(std::span<const std::byte> head) { return TensorFile::begins(head); }

BrdfFile parse_rgl(std::span<const std::byte> bytes, const std::string& file_name) {
  const TensorFile file(bytes, file_name);
  check_kind(file);
  std::vector<float> theta_i = ascending(file, "theta_i", upper_hemisphere);
  std::vector<float> phi_i = ascending(file, "phi_i", any_number);
  std::vector<BrdfChannel> channels = read_channels(file);
  const std::string name = file.has("spectra") ? "spectra" : "rgb";
  const TensorFile::Shape shape{phi_i.size(), theta_i.size(), channels.size(), std::nullopt,
                                std::nullopt};
  const auto [rows, columns] = grid_size(file, name, shape);
  const std::vector<float> values = file.floats(name, shape, any_number);
  BrdfFile result{.file = file_name, .format = BrdfFormat::rgl, .brdf = nullptr};
  result.description = file.text(file.field("description", TensorType::u8, {std::nullopt}));
  const int planes = mirror_planes(file, phi_i);
  HalfVectorWarp warp = read_warp(file, phi_i.size(), theta_i.size());
  UnitGrid sigma = unit_grid(file, "sigma", projected_area);
  UnitGrid ndf = unit_grid(file, "ndf", not_negative);
  result.brdf = std::make_shared<RglBrdf>(
      RglTables{.phi_i = std::move(phi_i),
                .theta_i = std::move(theta_i),
                .mirror_planes = planes,
                .sigma = std::move(sigma),
                .ndf = std::move(ndf),
                .warp = std::move(warp),
                .rows = rows,
                .columns = columns,
                .values = with_channels_last(values, channels.size(), rows * columns),
                .channels = channels});
  return result;
}

BrdfFile read_rgl(const std::filesystem::path& path) {
  const BinaryFile file(path);
  return parse_rgl(file.bytes(), path.string());
}

}  // namespace gonio
