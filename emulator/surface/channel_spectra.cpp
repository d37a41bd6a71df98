#include "emulator/surface/channel_spectra.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <stdexcept>

namespace gonio {

namespace {

using Band = BrdfChannel::Band;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Red and blue of the least slope, linear in between; green is the rest to 1. Computed for
/// D65 and the observer of 1931 in steps of 5 nm; rounded to five decimals.
struct RedBlue {
  double lambda_nm, red, blue;
};
constexpr std::array<RedBlue, 41> least_slope{{
    {380, 0.02489, 0.97511}, {390, 0.02488, 0.97512}, {400, 0.02483, 0.97517},
    {410, 0.02462, 0.97538}, {420, 0.02386, 0.97614}, {430, 0.02183, 0.97817},
    {440, 0.01891, 0.98109}, {450, 0.01916, 0.98084}, {460, 0.03185, 0.96815},
    {470, 0.01280, 0.87185}, {480, 0.00000, 0.69950}, {490, 0.00000, 0.49040},
    {500, 0.00000, 0.28659}, {510, 0.00000, 0.11780}, {520, 0.00000, 0.01405},
    {530, 0.00000, 0.00000}, {540, 0.00000, 0.00000}, {550, 0.00000, 0.00000},
    {560, 0.00000, 0.00000}, {570, 0.02227, 0.04549}, {580, 0.21097, 0.05116},
    {590, 0.47647, 0.03467}, {600, 0.73367, 0.01330}, {610, 0.91907, 0.00000},
    {620, 1.00000, 0.00000}, {630, 1.00000, 0.00000}, {640, 1.00000, 0.00000},
    {650, 1.00000, 0.00000}, {660, 1.00000, 0.00000}, {670, 1.00000, 0.00000},
    {680, 1.00000, 0.00000}, {690, 1.00000, 0.00000}, {700, 1.00000, 0.00000},
    {710, 1.00000, 0.00000}, {720, 1.00000, 0.00000}, {730, 1.00000, 0.00000},
    {740, 1.00000, 0.00000}, {750, 1.00000, 0.00000}, {760, 1.00000, 0.00000},
    {770, 1.00000, 0.00000}, {780, 1.00000, 0.00000},
}};

/// CIE XYZ of R, G and B, Y of white being 1. @see ITU-R BT.709
Eigen::Matrix3d xyz_of_rgb() {
  Eigen::Matrix3d result;
  result << 0.4124564, 0.3575761, 0.1804375, 0.2126729, 0.7151522, 0.0721750, 0.0193339, 0.1191920,
      0.9503041;
  return result;
}

/// Weights of linear interpolation between ascending nodes, constant beyond them; shape
/// (n_nodes, n_lambda).
MatrixXd hat_functions(const VectorXd& node_nm, const WavelengthGrid& grid) {
  MatrixXd weights = MatrixXd::Zero(node_nm.size(), grid.size());
  for (Index l = 0; l < grid.size(); ++l) {
    const double lambda = grid.nanometres()(l);
    const Index above = std::upper_bound(node_nm.begin(), node_nm.end(), lambda) - node_nm.begin();
    const Index low = std::max<Index>(above - 1, 0);
    const Index high = std::min<Index>(above, node_nm.size() - 1);
    const double share =
        low == high || above == 0 ? 0.0 : (lambda - node_nm(low)) / (node_nm(high) - node_nm(low));
    weights(low, l) = 1.0 - share;
    if (share > 0.0) {
      weights(high, l) = share;
    }
  }
  return weights;
}

/// Rows red, green, blue.
MatrixXd rgb_spectra(const WavelengthGrid& grid) {
  const auto n = Index(least_slope.size());
  VectorXd node(n);
  MatrixXd at_node(3, n);
  for (Index i = 0; i < n; ++i) {
    const auto& [lambda_nm, red, blue] = least_slope[std::size_t(i)];
    node(i) = lambda_nm;
    at_node.col(i) << red, 1.0 - red - blue, blue;
  }
  return at_node * hat_functions(node, grid);
}

/// Rows X, Y, Z.
MatrixXd xyz_spectra(const WavelengthGrid& grid) {
  const Eigen::Matrix3d rgb = xyz_of_rgb();
  const Eigen::Matrix3d relative = rgb.rowwise().sum().cwiseInverse().asDiagonal() * rgb;
  return relative.inverse().transpose() * rgb_spectra(grid);
}

/// Rows of `spectra` in the order in which the channels name `bands`; nothing if they do not name
/// each of them once.
MatrixXd in_order(const std::vector<BrdfChannel>& channels, const std::array<Band, 3>& bands,
                  const MatrixXd& spectra) {
  MatrixXd result = MatrixXd::Zero(Index(channels.size()), spectra.cols());
  std::array<int, 3> count{};
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const auto band = std::find(bands.begin(), bands.end(), channels[c].band) - bands.begin();
    if (band == 3) {
      return {};
    }
    ++count[std::size_t(band)];
    result.row(Index(c)) = spectra.row(band);
  }
  return count == std::array{1, 1, 1} ? result : MatrixXd{};
}

MatrixXd wavelength_spectra(const std::vector<BrdfChannel>& channels, const WavelengthGrid& grid) {
  VectorXd node(Index(channels.size()));
  for (std::size_t c = 0; c < channels.size(); ++c) {
    if (channels[c].band != Band::wavelength || !channels[c].wavelength) {
      return {};
    }
    node(Index(c)) = channels[c].wavelength->nanometres();
    if (c > 0 && !(node(Index(c)) > node(Index(c) - 1))) {
      return {};
    }
  }
  return hat_functions(node, grid);
}

}  // namespace

MatrixXd channel_spectra(const std::vector<BrdfChannel>& channels, const WavelengthGrid& grid) {
  if (channels.size() == 1 &&
      (channels[0].band == Band::luminance || channels[0].band == Band::y)) {
    return MatrixXd::Ones(1, grid.size());
  }
  if (!channels.empty()) {
    for (const MatrixXd& spectra :
         {wavelength_spectra(channels, grid),
          in_order(channels, {Band::red, Band::green, Band::blue}, rgb_spectra(grid)),
          in_order(channels, {Band::x, Band::y, Band::z}, xyz_spectra(grid))}) {
      if (spectra.size() > 0) {
        return spectra;
      }
    }
  }
  throw std::invalid_argument(
      "channel_spectra: needs ascending wavelengths, luminance, or all of R, G, B or X, Y, Z");
}

}  // namespace gonio
