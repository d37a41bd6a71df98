#include "emulator/procedure/measurement_equation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>
#include <unsupported/Eigen/AutoDiff>
#include <vector>

#include "emulator/instrument/glossmeter.hpp"
#include "emulator/instrument/signal.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/standard/shipped_standards.hpp"

namespace gonio {
namespace {

using Components = MeasurementEquation::Components<double>;
using test::is_close;
using test::is_close_relative;

constexpr double rounding_gu = 1e-11;

MeasurementEquation equation(const std::string& standard = "iso_2813/2014",
                             double theta_i_deg = 60.0) {
  return {.scale = test::shipped_standard(standard).scale,
          .theta_i = degrees(theta_i_deg),
          .full_scale_gu = 1000.0,
          .signal_per_k = -0.0003};
}

double& at(Components& d, UncertaintyComponent component) { return d[std::size_t(component)]; }

Components only(UncertaintyComponent component, double value) {
  Components d{};
  at(d, component) = value;
  return d;
}

/// All components at once, of the size of an instrument's.
Components some_of_all() {
  return {0.01, 0.02, 0.0004, 0.3, 0.0005, 0.08, -0.002, 1.5, 0.03, -0.04};
}

double sensitivity(const MeasurementEquation& equation, double g, UncertaintyComponent component,
                   const Components& d = {}) {
  return equation.gradient(g, d).by_component[std::size_t(component)];
}

// The reading.

TEST(MeasurementEquation, OfAnIdealInstrumentIsWhatTheOpticsRead) {
  for (const double g : {0.0, 1.0, 93.7, 1800.0}) {
    EXPECT_TRUE(is_close(equation().reading(g, Components{}), g, rounding_gu));
  }
}

TEST(MeasurementEquation, ReadsTheTileAsItsValueWhateverTheDetector) {
  for (const double zero : {-0.5, 0.0, 0.2}) {
    for (const double linearity : {-0.01, 0.0, 0.01}) {
      Components d{};
      at(d, UncertaintyComponent::zero) = zero;
      at(d, UncertaintyComponent::linearity) = linearity;
      EXPECT_TRUE(is_close(equation().reading(100.0, d), 100.0, rounding_gu));
    }
  }
}

TEST(MeasurementEquation, ReadsAZeroOfStrayLightAsLessTheMoreItReads) {
  const Components d = only(UncertaintyComponent::zero, 0.1);
  EXPECT_TRUE(is_close(equation().reading(0.0, d), 100.0 * 0.1 / 100.1, rounding_gu));
  EXPECT_LT(equation().reading(200.0, d), 200.0);
}

// The signal of a Behaviour of that stray light and linearity, warmer and older than when the
// tile was read, which was dirty.
TEST(MeasurementEquation, IsWhatTheSignalOfAnInstrumentComesTo) {
  constexpr double stray_light_gu = 0.13;
  Behaviour behaviour;
  behaviour.warm_up_s = 0.0;
  behaviour.linearity = 0.004;
  behaviour.full_scale_gu = {1000.0};
  behaviour.signal_per_k = -0.0003;
  const auto signal = [&](double g) {
    return clean_signal_gu(behaviour, 0, g, stray_light_gu, 0.0);
  };
  constexpr double contamination = 0.03;
  const double gain = 100.0 / signal((1.0 - contamination) * 100.0);
  behaviour.ambient_c += 4.0;
  behaviour.drift_per_h = 0.01;
  behaviour.drift_limit = 0.02;
  const double hour = 3600.0;
  Components d{};
  at(d, UncertaintyComponent::linearity) = behaviour.linearity;
  at(d, UncertaintyComponent::zero) = stray_light_gu;
  at(d, UncertaintyComponent::temperature) = 4.0;
  at(d, UncertaintyComponent::drift) = lamp_factor(behaviour, hour) - 1.0;
  MeasurementEquation dirty = equation();
  dirty.tile_contamination = contamination;
  for (const double g : {0.5, 40.0, 100.0, 900.0}) {
    const double shown = gain * clean_signal_gu(behaviour, 0, g, stray_light_gu, hour);
    EXPECT_TRUE(is_close(dirty.reading(g, d), shown, rounding_gu)) << g;
  }
}

TEST(MeasurementEquation, AssignsTheTileTheValueOfItsIndex) {
  constexpr double too_much = 0.01;
  for (const double theta_deg : {20.0, 60.0, 85.0}) {
    const MeasurementEquation here = equation("iso_2813/2014", theta_deg);
    const double found = here.reading(100.0, only(UncertaintyComponent::reference_index, too_much));
    EXPECT_TRUE(
        is_close(found, assigned_gloss(1.567 + too_much, here.theta_i, here.scale), rounding_gu));
  }
}

TEST(MeasurementEquation, LeavesOutTheGlassOnAScaleOfIncidentFlux) {
  const MeasurementEquation here = equation("astm_c346/87", 45.0);
  ASSERT_EQ(here.scale.reference, Scale::Reference::incident_flux);
  EXPECT_EQ(here.reading(50.0, only(UncertaintyComponent::reference_index, 0.1)),
            here.reading(50.0, Components{}));
  EXPECT_EQ(sensitivity(here, 50.0, UncertaintyComponent::reference_index), 0.0);
}

TEST(MeasurementEquation, WithoutAFullScaleIsLinear) {
  MeasurementEquation linear = equation();
  linear.full_scale_gu = 0.0;
  const Components d = only(UncertaintyComponent::linearity, 0.1);
  EXPECT_TRUE(is_close(linear.reading(37.0, d), 37.0, rounding_gu));
}

TEST(MeasurementEquation, ByAGainForAllSamplesIsTheSame) {
  const Components d = some_of_all();
  const double gain = equation().gain(d);
  for (const double g : {3.0, 100.0, 800.0}) {
    EXPECT_EQ(equation().reading(gain, g, d), equation().reading(g, d));
  }
}

// Its sensitivities.

TEST(Gradient, ByTheIndexOfThePrimaryStandardGivesTheFiguresKnown) {
  const std::vector<double> theta_deg{20.0, 60.0, 85.0}, known{0.274, 0.159, 0.0129};
  const std::vector<double> rounding{0.0005, 0.0005, 0.00005};
  for (std::size_t i = 0; i < known.size(); ++i) {
    const double found = sensitivity(equation("iso_2813/2014", theta_deg[i]), 100.0,
                                     UncertaintyComponent::reference_index);
    EXPECT_TRUE(is_close(0.001 * found, known[i], rounding[i]));
  }
}

TEST(Gradient, OfAnIdealInstrumentHasClosedForms) {
  for (const double g : {5.0, 100.0, 700.0}) {
    const MeasurementEquation::Gradient found = equation().gradient(g, {});
    const Components& c = found.by_component;
    const auto of = [&](UncertaintyComponent component) { return c[std::size_t(component)]; };
    EXPECT_TRUE(is_close(found.reading, g, rounding_gu));
    EXPECT_TRUE(is_close(found.by_optics, 1.0, rounding_gu));
    EXPECT_EQ(of(UncertaintyComponent::polarization), 0.0);
    EXPECT_EQ(of(UncertaintyComponent::spectral_mismatch), 0.0);
    EXPECT_TRUE(is_close(of(UncertaintyComponent::reference_value), g / 100.0, rounding_gu));
    EXPECT_TRUE(is_close(of(UncertaintyComponent::linearity), 4.0 * g * (100.0 - g) / 1000.0,
                         1e3 * rounding_gu));
    EXPECT_TRUE(is_close(of(UncertaintyComponent::zero), 1.0 - g / 100.0, rounding_gu));
    EXPECT_TRUE(is_close(of(UncertaintyComponent::drift), g, rounding_gu));
    EXPECT_TRUE(is_close(of(UncertaintyComponent::temperature), -0.0003 * g, rounding_gu));
    EXPECT_EQ(of(UncertaintyComponent::resolution), 1.0);
    EXPECT_EQ(of(UncertaintyComponent::repeatability), 1.0);
  }
}

TEST(Gradient, IsThatOfAnyNumberThatCarriesDerivatives) {
  using Number = Eigen::AutoDiffScalar<Eigen::VectorXd>;
  const Components d = some_of_all();
  MeasurementEquation::Components<Number> numbers;
  std::ranges::copy(d, numbers.begin());  // constants: no derivatives
  const auto zero = std::size_t(UncertaintyComponent::zero);
  numbers[zero] = Number(d[zero], 2, 0);
  const Number found = equation().reading(Number(60.0, 2, 1), numbers);
  const MeasurementEquation::Gradient expected = equation().gradient(60.0, d);
  ASSERT_EQ(found.derivatives().size(), 2);
  EXPECT_TRUE(is_close(found.derivatives()(0), expected.by_component[zero], 1e-13));
  EXPECT_TRUE(is_close(found.derivatives()(1), expected.by_optics, 1e-13));
}

TEST(Gradient, AgreesWithFiniteDifferencesAnywhere) {
  constexpr double agreement = 1e-6;  // relative, of central differences with the steps below
  const MeasurementEquation here = equation();
  const Components d = some_of_all();
  for (const double g : {2.0, 60.0, 950.0}) {
    const MeasurementEquation::Gradient found = here.gradient(g, d);
    EXPECT_TRUE(is_close_relative(found.reading, here.reading(g, d), 1e-14));
    constexpr double step_gu = 1e-3;
    EXPECT_TRUE(is_close_relative(
        found.by_optics, (here.reading(g + step_gu, d) - here.reading(g - step_gu, d)) / 2e-3,
        agreement));
    for (std::size_t i = 0; i < d.size(); ++i) {
      const double step = 1e-5;
      Components more = d, less = d;
      more[i] += step;
      less[i] -= step;
      const double difference = (here.reading(g, more) - here.reading(g, less)) / (2 * step);
      EXPECT_TRUE(is_close(found.by_component[i], difference,
                           agreement * std::max(1.0, std::abs(difference))))
          << uncertainty_component_names[i];
    }
  }
}

}  // namespace
}  // namespace gonio
