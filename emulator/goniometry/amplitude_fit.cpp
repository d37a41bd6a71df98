#include "emulator/goniometry/amplitude_fit.hpp"

#include <Eigen/QR>
#include <limits>
#include <optional>

namespace gonio {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Amplitudes of which those not in `set` are 0, and the sum is the limit if `is_full`.
struct Face {
  VectorXd start;  ///< a point of it
  MatrixXd free;   ///< its directions, shape (p, n)
};

std::optional<Face> face_of(unsigned set, bool is_full, Index p, double limit) {
  std::vector<Index> members;
  for (Index i = 0; i < p; ++i) {
    if ((set >> unsigned(i)) & 1U) {
      members.push_back(i);
    }
  }
  const Index n = Index(members.size());
  if (is_full && n == 0) {
    return std::nullopt;
  }
  Face face{.start = VectorXd::Zero(p), .free = MatrixXd::Zero(p, is_full ? n - 1 : n)};
  if (!is_full) {
    for (Index j = 0; j < n; ++j) {
      face.free(members[std::size_t(j)], j) = 1.0;
    }
    return face;
  }
  MatrixXd spread = MatrixXd::Zero(p, n);  // the first column is the sum, the others span the rest
  for (Index j = 0; j < n; ++j) {
    const Index member = members[std::size_t(j)];
    face.start(member) = limit / double(n);
    spread(member, 0) = 1.0;
    if (j > 0) {
      spread(member, j) = 1.0;
    }
  }
  const MatrixXd orthonormal = spread.householderQr().householderQ() * MatrixXd::Identity(p, n);
  face.free = orthonormal.rightCols(n - 1);
  return face;
}

}  // namespace

AmplitudeFit fit_amplitudes(const MatrixXd& terms, const VectorXd& observed, double limit) {
  constexpr double rounding = 1e-12;
  const Index p = terms.cols();
  AmplitudeFit best{.amplitudes = VectorXd::Zero(p),
                    .sum_of_squares = std::numeric_limits<double>::infinity()};
  for (unsigned set = 0; set < (1U << unsigned(p)); ++set) {
    for (const bool is_full : {false, true}) {
      const auto face = face_of(set, is_full, p, limit);
      if (!face) {
        continue;
      }
      VectorXd k = face->start;
      if (face->free.cols() > 0) {
        const MatrixXd along = terms * face->free;
        k += face->free * along.colPivHouseholderQr().solve(observed - terms * k);
      }
      if (k.size() > 0 && (k.minCoeff() < -rounding || k.sum() > limit + rounding)) {
        continue;
      }
      k = k.cwiseMax(0.0);
      const double sum = (observed - terms * k).squaredNorm();
      if (sum < best.sum_of_squares) {
        best = {.amplitudes = k, .free = face->free, .sum_of_squares = sum};
      }
    }
  }
  return best;
}

}  // namespace gonio
