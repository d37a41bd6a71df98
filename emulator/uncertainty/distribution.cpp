#include "emulator/uncertainty/distribution.hpp"

#include <fmt/format.h>

#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace gonio {

namespace {

using Shape = Distribution::Shape;

/// Half width over standard uncertainty; 0 for a shape without bounds.
double half_widths_per_uncertainty(Shape shape) {
  switch (shape) {
    case Shape::rectangular:
      return std::numbers::sqrt3;
    case Shape::triangular:
      return std::numbers::sqrt3 * std::numbers::sqrt2;
    case Shape::arcsine:
      return std::numbers::sqrt2;
    default:
      return 0.0;
  }
}

void expect_inside(const char* function, const char* name, double value, double high) {
  if (!(value > 0.0 && value < high)) {
    throw std::domain_error(
        fmt::format("{}: expected {} in (0, {}), found {}", function, name, high, value));
  }
}

void expect_degrees_of_freedom(const char* function, double degrees_of_freedom) {
  if (!(degrees_of_freedom > 0.0)) {
    throw std::domain_error(
        fmt::format("{}: expected degrees of freedom > 0, found {}", function, degrees_of_freedom));
  }
}

double normal_quantile(double p) { return -std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * p); }

double student_quantile(double degrees_of_freedom, double p) {
  return std::isinf(degrees_of_freedom)
             ? normal_quantile(p)
             : boost::math::quantile(boost::math::students_t(degrees_of_freedom), p);
}

/// Of a half width of 1.
double bounded_quantile(Shape shape, double p) {
  switch (shape) {
    case Shape::rectangular:
      return 2.0 * p - 1.0;
    case Shape::triangular:
      return p < 0.5 ? std::sqrt(2.0 * p) - 1.0 : 1.0 - std::sqrt(2.0 * (1.0 - p));
    default:
      return std::sin(std::numbers::pi * (p - 0.5));
  }
}

}  // namespace

Distribution Distribution::bounded(Shape shape, double half_width) {
  const double ratio = half_widths_per_uncertainty(shape);
  if (ratio == 0.0) {
    throw std::domain_error("Distribution::bounded: expected a shape with bounds");
  }
  if (!(half_width >= 0.0)) {
    throw std::domain_error(
        fmt::format("Distribution::bounded: expected a half width >= 0, found {}", half_width));
  }
  return {.shape = shape, .standard_uncertainty = half_width / ratio};
}

double Distribution::half_width() const {
  const double ratio = half_widths_per_uncertainty(shape);
  return ratio == 0.0 ? std::numeric_limits<double>::infinity() : ratio * standard_uncertainty;
}

double quantile(const Distribution& distribution, double p) {
  expect_inside("quantile", "p", p, 1.0);
  if (!(distribution.standard_uncertainty >= 0.0)) {
    throw std::domain_error(fmt::format("quantile: expected a standard uncertainty >= 0, found {}",
                                        distribution.standard_uncertainty));
  }
  if (half_widths_per_uncertainty(distribution.shape) > 0.0) {
    return distribution.half_width() * bounded_quantile(distribution.shape, p);
  }
  expect_degrees_of_freedom("quantile", distribution.degrees_of_freedom);
  return distribution.standard_uncertainty * student_quantile(distribution.degrees_of_freedom, p);
}

double coverage_factor(double degrees_of_freedom, double coverage) {
  expect_degrees_of_freedom("coverage_factor", degrees_of_freedom);
  expect_inside("coverage_factor", "a coverage", coverage, 1.0);
  return student_quantile(degrees_of_freedom, 0.5 * (1.0 + coverage));
}

}  // namespace gonio
