#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace gonio {

/// A function of some parameters that is dear to evaluate, as a polynomial of a total degree in
/// their deviations from a centre: least squares over points of a low-discrepancy sequence in a
/// box.
class PolynomialSurrogate {
 public:
  /// @return  values of the outputs, shape (n_outputs). Called from several threads.
  using Function = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

  struct Options {
    double target_error = 5e-4;  ///< in the unit of the outputs
    int highest_degree = 10;     ///< >= 1; raised from 2 until the target is met
    /// A higher degree that has more is not tried: of 8 free parameters that is the fifth.
    std::size_t most_terms = 500;
    std::uint64_t seed = 1;  ///< of the places of the points
  };

  /// @param half_width  of the box, >= 0, shape of `centre`; a parameter of half width 0 is fixed.
  /// @throws std::invalid_argument  for another shape, a negative width or degree.
  /// @throws std::domain_error      for a function that is not finite somewhere in the box.
  static PolynomialSurrogate fit(const Function& function, const Eigen::VectorXd& centre,
                                 const Eigen::VectorXd& half_width, const Options& options);

  /// May be called from several threads.
  /// @param x  parameters, shape (n, n_parameters); what lies beyond the box counts as at its edge.
  /// @param y  result, shape (n, n_outputs).
  void evaluate(const Eigen::ArrayXXd& x, Eigen::ArrayXXd& y) const;

  /// The largest deviation from the function at points that it was not fitted to, by output: the
  /// centre, the ends of the axes, and others of the sequence.
  [[nodiscard]] const Eigen::VectorXd& error() const { return error_; }
  [[nodiscard]] int degree() const { return degree_; }
  /// Of the function.
  [[nodiscard]] std::size_t evaluations() const { return evaluations_; }

 private:
  /// A monomial: another one times a free parameter. The first is 1.
  struct Term {
    Eigen::Index factor = 0;     // its place among the terms
    Eigen::Index parameter = 0;  // place among the free parameters
  };

  PolynomialSurrogate(const Eigen::VectorXd& centre, const Eigen::VectorXd& half_width);
  [[nodiscard]] Eigen::VectorXd parameters(const Eigen::VectorXd& t) const;
  void set_degree(int degree);
  [[nodiscard]] Eigen::Index n_terms() const { return Eigen::Index(terms_.size()) + 1; }
  void monomials(Eigen::Ref<const Eigen::MatrixXd> t, Eigen::Ref<Eigen::MatrixXd> m) const;

  Eigen::VectorXd centre_, half_width_;
  std::vector<Eigen::Index> free_ = {};  // parameters of half width > 0
  std::vector<Term> terms_ = {};         // all but the first, by degree
  Eigen::MatrixXd coefficients_;         // shape (n_terms, n_outputs)
  Eigen::VectorXd error_;
  int degree_ = 0;
  std::size_t evaluations_ = 0;
};

}  // namespace gonio
