#include "emulator/optics/dispersion_formula.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gonio {

namespace {

using Coefficients = std::array<double, 17>;

double squared(double x) { return x * x; }

/// Sum of term(amplitude, shape) over the pairs of coefficients from `first` on. A pair without
/// amplitude is left out, since its shape may have no value at 0, as 0^0 or 1/0.
template <class Term>
double sum_of_pairs(const Coefficients& c, std::size_t first, Term term) {
  double sum = 0.0;
  for (std::size_t i = first; i + 1 < c.size(); i += 2) {
    if (c[i] != 0.0) {
      sum += term(c[i], c[i + 1]);
    }
  }
  return sum;
}

double sellmeier(const Coefficients& c, double l) {
  return std::sqrt(1.0 + c[0] + sum_of_pairs(c, 1, [l](double a, double resonance_um) {
                     return a * l * l / (l * l - squared(resonance_um));
                   }));
}

double sellmeier_2(const Coefficients& c, double l) {
  return std::sqrt(1.0 + c[0] + sum_of_pairs(c, 1, [l](double a, double resonance_um2) {
                     return a * l * l / (l * l - resonance_um2);
                   }));
}

double powers(const Coefficients& c, std::size_t first, double l) {
  return sum_of_pairs(c, first, [l](double a, double power) { return a * std::pow(l, power); });
}

double general(const Coefficients& c, double l) {
  double square = c[0] + powers(c, 9, l);
  for (const std::size_t i : {std::size_t{1}, std::size_t{5}}) {
    if (c[i] != 0.0) {
      square += c[i] * std::pow(l, c[i + 1]) / (l * l - std::pow(c[i + 2], c[i + 3]));
    }
  }
  return std::sqrt(square);
}

double gases(const Coefficients& c, double l) {
  return 1.0 + c[0] + sum_of_pairs(c, 1, [l](double a, double resonance) {
           return a / (resonance - 1.0 / (l * l));
         });
}

double herzberger(const Coefficients& c, double l) {
  const double l2 = l * l;
  const double pole = 1.0 / (l2 - 0.028);
  return c[0] + c[1] * pole + c[2] * pole * pole + l2 * (c[3] + l2 * (c[4] + l2 * c[5]));
}

double retro(const Coefficients& c, double l) {
  const double resonance = c[1] == 0.0 ? 0.0 : c[1] * l * l / (l * l - c[2]);
  const double lorentz_lorenz = c[0] + resonance + c[3] * l * l;
  return std::sqrt((1.0 + 2.0 * lorentz_lorenz) / (1.0 - lorentz_lorenz));
}

double exotic(const Coefficients& c, double l) {
  double square = c[0];
  if (c[1] != 0.0) {
    square += c[1] / (l * l - c[2]);
  }
  if (c[3] != 0.0) {
    square += c[3] * (l - c[4]) / (squared(l - c[4]) + c[5]);
  }
  return std::sqrt(square);
}

}  // namespace

DispersionFormula::DispersionFormula(int number, std::span<const double> coefficients)
    : number_(number) {
  if (coefficients.empty() || coefficients.size() > most_coefficients(number)) {
    throw std::invalid_argument(
        fmt::format("DispersionFormula: formula {} takes 1 to {} coefficients, not {}", number,
                    most_coefficients(number), coefficients.size()));
  }
  std::copy(coefficients.begin(), coefficients.end(), c_.begin());
}

double DispersionFormula::at(Wavelength lambda) const {
  const double l = lambda.micrometres();
  switch (number_) {
    case 1:
      return sellmeier(c_, l);
    case 2:
      return sellmeier_2(c_, l);
    case 3:
      return std::sqrt(c_[0] + powers(c_, 1, l));
    case 4:
      return general(c_, l);
    case 5:
      return c_[0] + powers(c_, 1, l);
    case 6:
      return gases(c_, l);
    case 7:
      return herzberger(c_, l);
    case 8:
      return retro(c_, l);
    default:
      return exotic(c_, l);
  }
}

std::size_t DispersionFormula::most_coefficients(int number) {
  constexpr std::array<std::size_t, 9> most = {17, 17, 17, 17, 11, 11, 6, 4, 6};
  if (number < 1 || number > int(most.size())) {
    throw std::invalid_argument(fmt::format("DispersionFormula: no formula {}", number));
  }
  return most[std::size_t(number - 1)];
}

}  // namespace gonio
