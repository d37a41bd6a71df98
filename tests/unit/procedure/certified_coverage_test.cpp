// Ten thousand instruments are built and measured by generators of their own, and read samples;
// each gets the uncertainty that a certificate would state. How often does it cover the error?
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "emulator/procedure/reading_model.hpp"
#include "emulator/uncertainty/propagation.hpp"
#include "tests/unit/procedure/certification.hpp"
#include "tests/unit/trials.hpp"

namespace gonio {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::rungs;
using test::triangle_gloss;

constexpr std::size_t instruments = test::trials(10'000);
constexpr std::uint64_t seed = 2813;
/// Ten readings to tell the repeatability from.
const std::string ten_readings =
    "{uncertainty: {repeatability: {standard_uncertainty: 0.1 GU, degrees_of_freedom: 9}}}";

/// A deviate of what is known of an input: written anew, not by the code under test.
double deviate(const Distribution& distribution, std::mt19937_64& random) {
  const double u = distribution.standard_uncertainty;
  std::uniform_real_distribution<double> side(-1.0, 1.0);
  switch (distribution.shape) {
    case Distribution::Shape::rectangular:
      return std::sqrt(3.0) * u * side(random);
    case Distribution::Shape::triangular:
      return std::sqrt(6.0) / 2.0 * u * (side(random) + side(random));
    case Distribution::Shape::arcsine:
      return std::sqrt(2.0) * u * std::sin(M_PI / 2.0 * side(random));
    default:
      return u * std::normal_distribution<double>()(random);
  }
}

/// An instrument of which the file tells the set-up `measured`, while it is `built`.
struct Built {
  VectorXd measured, built;  // all inputs
  double repeatability_gu;   // as estimated from a few readings
};

/// The estimates, of set-ups spread over half the tolerances of the standard and more.
Built draw(const InputSet& set, const GeometryInputs& geometry, const VectorXd& spread,
           std::mt19937_64& random) {
  const auto& inputs = set.inputs();
  Built result{.measured = VectorXd(Index(inputs.size())),
               .built = VectorXd(Index(inputs.size())),
               .repeatability_gu = 0.0};
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto at = Index(i);
    result.measured[at] = inputs[i].estimate;
    result.built[at] = inputs[i].estimate + deviate(inputs[i].distribution, random);
  }
  std::uniform_real_distribution<double> side(-1.0, 1.0);
  for (std::size_t i = 0; i < geometry.setup.size(); ++i) {
    const double shift = spread[Index(i)] * side(random);
    result.measured[Index(geometry.setup_index[i])] += shift;
    result.built[Index(geometry.setup_index[i])] += shift;
  }
  const std::size_t place =
      geometry.component_index[std::size_t(UncertaintyComponent::repeatability)];
  const Distribution& noise = inputs[place].distribution;
  result.repeatability_gu = noise.standard_uncertainty;
  if (std::isfinite(noise.degrees_of_freedom)) {
    std::chi_squared_distribution<double> chi_squared(noise.degrees_of_freedom);
    result.repeatability_gu *= std::sqrt(chi_squared(random) / noise.degrees_of_freedom);
  }
  return result;
}

/// The same inputs, as the certificate of that instrument has them.
InputSet as_stated(const InputSet& set, std::size_t repeatability, double stated_gu) {
  InputSet stated;
  for (InputQuantity input : set.inputs()) {
    if (stated.size() == repeatability) {
      input.distribution.standard_uncertainty = stated_gu;
    }
    (void)stated.add(std::move(input));
  }
  return stated;
}

/// Instruments of one geometry, whose set-ups lie up to 0.05 deg about that of a file.
class Workshop {
 public:
  Workshop(Instrument instrument, const char* geometry)
      : instrument_(std::move(instrument)),
        inputs_(uncertainty_inputs(instrument_, {geometry})),
        model_(instrument_, inputs_.set, inputs_.geometries[0], ladder_, 1e-6),
        spread_(VectorXd::Zero(model_.optics().size())),
        optics_(fit()) {}

  const std::vector<Sample>& ladder() const { return ladder_; }
  const InputSet& inputs() const { return inputs_.set; }
  std::size_t repeatability() const {
    return geometry().component_index[std::size_t(UncertaintyComponent::repeatability)];
  }

  Built build(std::mt19937_64& random) const { return draw(inputs(), geometry(), spread_, random); }

  VectorXd read(const VectorXd& x) const {
    Eigen::ArrayXXd parameters(1, Index(place_.size())), g(1, Index(ladder_.size()));
    parameters.row(0) = x(place_).transpose();
    optics_.evaluate(parameters, g);
    return model_.of_optics(g.row(0).matrix().transpose(), x);
  }

  MatrixXd sensitivity(const VectorXd& x) const {
    MatrixXd result = MatrixXd::Zero(Index(ladder_.size()), x.size());
    for (Index i = 0; i < x.size(); ++i) {
      const double u = inputs().inputs()[std::size_t(i)].distribution.standard_uncertainty;
      if (u > 0.0) {
        VectorXd up = x, down = x;
        up[i] += 0.1 * u;
        down[i] -= 0.1 * u;
        result.col(i) = (read(up) - read(down)) / (0.2 * u);
      }
    }
    return result;
  }

 private:
  const GeometryInputs& geometry() const { return inputs_.geometries[0]; }

  /// One polynomial over all set-ups that can occur stands for the optics.
  PolynomialSurrogate fit() {
    spread_.head(Index(geometry().setup.size())).setConstant(0.05);
    for (const std::size_t index : geometry().setup_index) {
      place_.push_back(Index(index));
    }
    for (const auto component :
         {UncertaintyComponent::polarization, UncertaintyComponent::spectral_mismatch}) {
      place_.push_back(Index(geometry().component_index[std::size_t(component)]));
    }
    VectorXd reach = spread_;
    for (Index i = 0; i < reach.size(); ++i) {
      const InputQuantity& input = inputs().inputs()[std::size_t(place_[std::size_t(i)])];
      reach[i] += 5.0 * input.distribution.standard_uncertainty;
    }
    const OpticalResponse& optics = model_.optics();
    auto result = PolynomialSurrogate::fit([&](const VectorXd& x) { return optics(x); },
                                           optics.as_built(), reach, {});
    EXPECT_LT(result.error().maxCoeff(), 5e-3);  // far below U
    return result;
  }

  std::vector<Index> place_ = {};  // of the parameters of the optics among the inputs
  std::vector<Sample> ladder_ = rungs({"glass_m050", "paint_smooth", "copper_m065"});
  Instrument instrument_;
  UncertaintyInputs inputs_;
  ReadingModel model_;
  VectorXd spread_;

  PolynomialSurrogate optics_;
};

/// So that each input can be drawn alone.
Instrument independent(Instrument instrument) {
  instrument.uncertainty->correlations.clear();
  return instrument;
}

void expect_95_percent(const std::vector<std::size_t>& covered, const Workshop& workshop) {
  for (std::size_t s = 0; s < covered.size(); ++s) {
    const double share = double(covered[s]) / double(instruments);
    // Of ten thousand 94 to 96 %, which leaves 4.6 standard deviations to chance.
    EXPECT_NEAR(share, 0.95, test::chance_about_95_percent(instruments, 4.6))
        << workshop.ladder()[s].id;
  }
}

class CertifiedCoverage : public testing::TestWithParam<const char*> {};

/// Where the law of propagation holds: distributions that are normal or Student's.
TEST_P(CertifiedCoverage, OfTheLawOfPropagationIs95Percent) {
  Instrument instrument = triangle_gloss(test::all_normal);
  instrument = with_overlay(instrument, YamlNode::parse(ten_readings, "overlay"), test::shipped());
  const Workshop workshop(independent(instrument), GetParam());
  std::mt19937_64 random(seed);
  std::vector<std::size_t> covered(workshop.ladder().size(), 0);
  for (std::size_t n = 0; n < instruments; ++n) {
    const Built one = workshop.build(random);
    const VectorXd error = workshop.read(one.built) - workshop.read(one.measured);
    const MatrixXd sensitivity = workshop.sensitivity(one.measured);
    const InputSet stated =
        as_stated(workshop.inputs(), workshop.repeatability(), one.repeatability_gu);
    for (std::size_t s = 0; s < covered.size(); ++s) {
      const double U =
          propagate(stated, sensitivity.row(Index(s)).transpose()).expanded_uncertainty;
      covered[s] += std::abs(error[Index(s)]) <= U ? 1 : 0;
    }
  }
  expect_95_percent(covered, workshop);
}

/// With the distributions of the shipped file, whatever they are.
TEST_P(CertifiedCoverage, OfMonteCarloIs95Percent) {
  const Instrument instrument = independent(triangle_gloss());
  const Workshop workshop(instrument, GetParam());
  const Certificate certificate =
      certify(instrument, test::clauses_of("iso_2813/2014"), workshop.ladder(),
              {.geometries = {GetParam()}, .trials = test::trials(200'000)});
  std::mt19937_64 random(seed);
  std::vector<std::size_t> covered(workshop.ladder().size(), 0);
  for (std::size_t n = 0; n < instruments; ++n) {
    const Built one = workshop.build(random);
    const VectorXd error = workshop.read(one.built) - workshop.read(one.measured);
    for (std::size_t s = 0; s < covered.size(); ++s) {
      const CertifiedReading& stated = certificate.geometries[0].readings[s];
      const double low = stated.monte_carlo.low - stated.gloss_gu;
      const double high = stated.monte_carlo.high - stated.gloss_gu;
      covered[s] += error[Index(s)] >= low && error[Index(s)] <= high ? 1 : 0;
    }
  }
  expect_95_percent(covered, workshop);
}

INSTANTIATE_TEST_SUITE_P(Geometries, CertifiedCoverage, testing::Values("20", "60", "85"),
                         [](const auto& tested) { return std::string("At") + tested.param; });

}  // namespace
}  // namespace gonio
