#include "emulator/procedure/polynomial_surrogate.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "emulator/core/parallel_for.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int lowest_degree = 2;
/// Points for each coefficient: enough that least squares is as good as interpolation is at best.
constexpr double oversampling = 2.0;
constexpr Index validation_points = 128;
/// Rows that are evaluated together: their monomials stay in the cache.
constexpr Index block_rows = 64;

/// The additive recurrence of the generalised golden ratio, shifted by a seed, with points denser
/// towards the faces of the cube, where a polynomial that is fitted would swing.
/// @see Roberts, "The unreasonable effectiveness of quasirandom sequences" (2018)
class PointSequence {
 public:
  PointSequence(Index dimensions, std::uint64_t seed) : step_(dimensions), shift_(dimensions) {
    double ratio = 2.0;
    for (int i = 0; i < 60; ++i) {
      ratio = std::pow(1.0 + ratio, 1.0 / (double(dimensions) + 1.0));
    }
    std::mt19937_64 bits(seed);
    for (Index d = 0; d < dimensions; ++d) {
      step_(d) = std::pow(ratio, -double(d + 1));
      shift_(d) = double(bits() >> 11) * 0x1p-53;
    }
  }

  /// Those numbered from `begin` to before `end`, in the cube [-1, 1]^d, shape (end - begin, d).
  [[nodiscard]] MatrixXd points(Index begin, Index end) const {
    MatrixXd result(end - begin, step_.size());
    for (Index i = begin; i < end; ++i) {
      const ArrayXd x = shift_ + double(i) * step_;
      result.row(i - begin) = -((x - x.floor()) * EIGEN_PI).cos();
    }
    return result;
  }

 private:
  ArrayXd step_, shift_;
};

/// Points of the cube [-1, 1]^d where a function is to be fitted or compared, and its values there.
struct Points {
  MatrixXd t = {};      // shape (n, d)
  MatrixXd value = {};  // shape (n, n_outputs)

  /// @param more  shape (n_more, d).
  void add(const MatrixXd& more, const PolynomialSurrogate::Function& function) {
    const Index before = t.rows();
    t.conservativeResize(before + more.rows(), more.cols());
    t.bottomRows(more.rows()) = more;
    std::vector<VectorXd> found(std::size_t(more.rows()));
    parallel_for(found.size(), [&](std::size_t i) {
      found[i] = function(more.row(Index(i)).transpose());
      if (!found[i].allFinite()) {
        throw std::domain_error("PolynomialSurrogate::fit: the function must be finite in the box");
      }
    });
    for (std::size_t i = 0; i < found.size(); ++i) {
      value.conservativeResize(t.rows(), found[i].size());
      value.row(before + Index(i)) = found[i].transpose();
    }
  }
};

/// How many monomials there are up to a total degree: d + degree over degree.
Index terms_of(Index dimensions, int degree) {
  Index n = 1;
  for (int i = 1; i <= degree; ++i) {
    n = n * (dimensions + i) / i;
  }
  return n;
}

/// The centre, the ends of the axes, and others far away in the sequence.
MatrixXd points_to_compare(Index dimensions, const PointSequence& sequence) {
  constexpr Index far_away = 1 << 20;
  MatrixXd t(1 + 2 * dimensions + validation_points, dimensions);
  t << VectorXd::Zero(dimensions).transpose(), MatrixXd::Identity(dimensions, dimensions),
      -MatrixXd::Identity(dimensions, dimensions),
      sequence.points(far_away, far_away + validation_points);
  return t;
}

}  // namespace

PolynomialSurrogate::PolynomialSurrogate(const VectorXd& centre, const VectorXd& half_width)
    : centre_(centre), half_width_(half_width) {
  for (Index p = 0; p < centre.size(); ++p) {
    if (half_width(p) > 0.0) {
      free_.push_back(p);
    }
  }
}

/// @param t  free parameters in units of the box, shape (n_free).
VectorXd PolynomialSurrogate::parameters(const VectorXd& t) const {
  VectorXd x = centre_;
  for (std::size_t d = 0; d < free_.size(); ++d) {
    x(free_[d]) += half_width_(free_[d]) * t(Index(d));
  }
  return x;
}

void PolynomialSurrogate::set_degree(int degree) {
  degree_ = degree;
  terms_.clear();
  // Each monomial once: its parameters in ascending order. Those of the degree before begin at
  // `first`; 0 is the constant.
  std::vector<Index> last_parameter{0};
  std::size_t first = 0;
  for (int d = 1; d <= degree; ++d) {
    const std::size_t end = last_parameter.size();
    for (std::size_t factor = first; factor < end; ++factor) {
      for (auto p = last_parameter[factor]; p < Index(free_.size()); ++p) {
        terms_.push_back({.factor = Index(factor), .parameter = p});
        last_parameter.push_back(p);
      }
    }
    first = end;
  }
}

/// @param t  parameters in units of the box, shape (n, n_free).
/// @param m  result, shape (n, n_terms).
void PolynomialSurrogate::monomials(Eigen::Ref<const MatrixXd> t, Eigen::Ref<MatrixXd> m) const {
  m.col(0).setOnes();
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    m.col(Index(k) + 1) = m.col(terms_[k].factor).cwiseProduct(t.col(terms_[k].parameter));
  }
}

PolynomialSurrogate PolynomialSurrogate::fit(const Function& function, const VectorXd& centre,
                                             const VectorXd& half_width, const Options& options) {
  if (centre.size() != half_width.size() || !(half_width.array() >= 0.0).all() ||
      options.highest_degree < 1) {
    throw std::invalid_argument(fmt::format(
        "PolynomialSurrogate::fit: {} half widths >= 0 and a degree >= 1 expected", centre.size()));
  }
  PolynomialSurrogate result(centre, half_width);
  const Function scaled = [&](const VectorXd& t) { return function(result.parameters(t)); };
  const auto dimensions = Index(result.free_.size());
  if (dimensions == 0) {
    result.coefficients_ = function(centre).transpose();
    result.error_ = VectorXd::Zero(result.coefficients_.cols());
    result.evaluations_ = 1;
    return result;
  }
  const PointSequence sequence(dimensions, options.seed);
  Points fresh;
  fresh.add(points_to_compare(dimensions, sequence), scaled);
  Points fitted;
  for (int degree = std::min(lowest_degree, options.highest_degree);
       degree <= options.highest_degree; ++degree) {
    if (degree > lowest_degree && terms_of(dimensions, degree) > Index(options.most_terms)) {
      break;
    }
    result.set_degree(degree);
    const auto n = Index(std::ceil(oversampling * double(result.n_terms())));
    fitted.add(sequence.points(fitted.t.rows(), n), scaled);
    MatrixXd m(n, result.n_terms());
    result.monomials(fitted.t, m);
    result.coefficients_ = m.householderQr().solve(fitted.value);
    m.resize(fresh.t.rows(), Eigen::NoChange);
    result.monomials(fresh.t, m);
    result.error_ = (m * result.coefficients_ - fresh.value).cwiseAbs().colwise().maxCoeff();
    if (result.error_.maxCoeff() <= options.target_error) {
      break;
    }
  }
  result.evaluations_ = std::size_t(fresh.t.rows() + fitted.t.rows());
  return result;
}

void PolynomialSurrogate::evaluate(const ArrayXXd& x, ArrayXXd& y) const {
  if (x.cols() != centre_.size()) {
    throw std::invalid_argument(fmt::format(
        "PolynomialSurrogate::evaluate: {} parameters expected, are {}", centre_.size(), x.cols()));
  }
  y.resize(x.rows(), coefficients_.cols());
  const Index most = std::min(block_rows, x.rows());
  MatrixXd t(most, Index(free_.size()));
  MatrixXd m(most, coefficients_.rows());
  for (Index begin = 0; begin < x.rows(); begin += block_rows) {
    const Index n = std::min(block_rows, x.rows() - begin);
    for (std::size_t d = 0; d < free_.size(); ++d) {
      const Index p = free_[d];
      t.col(Index(d)).head(n) =
          ((x.col(p).segment(begin, n) - centre_(p)) / half_width_(p)).max(-1.0).min(1.0).matrix();
    }
    monomials(t.topRows(n), m.topRows(n));
    y.middleRows(begin, n).matrix().noalias() = m.topRows(n) * coefficients_;
  }
}

}  // namespace gonio
