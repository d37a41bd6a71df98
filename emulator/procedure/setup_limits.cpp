#include "emulator/procedure/setup_limits.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "emulator/core/unit_value.hpp"
#include "emulator/instrument/signal.hpp"

namespace gonio {

namespace {

constexpr double k = 2.0;  // of the expanded uncertainties that are judged

/// A value, and its expanded uncertainty.
struct Found {
  double value = 0.0;
  double expanded_uncertainty = 0.0;
};

/// The largest standard uncertainty stated of a component; 0 if there is none.
double largest_uncertainty(const Instrument& instrument, UncertaintyComponent component) {
  double largest = 0.0;
  if (instrument.uncertainty) {
    const auto found = instrument.uncertainty->components.find(component);
    if (found != instrument.uncertainty->components.end()) {
      for (const auto& [geometry, distribution] : found->second) {
        largest = std::max(largest, distribution.standard_uncertainty);
      }
    }
  }
  return largest;
}

double correlation_of_angles(const Instrument& instrument, const std::string& geometry) {
  if (instrument.uncertainty) {
    for (const StatedCorrelation& stated : instrument.uncertainty->correlations) {
      const auto names = std::minmax(stated.a, stated.b);
      if (names.first == "theta_i" && names.second == "theta_r" &&
          stated.geometry.value_or(geometry) == geometry) {
        return stated.coefficient;
      }
    }
  }
  return 0.0;
}

std::optional<Found> setup_found(const Instrument& instrument, const std::string& geometry,
                                 SetupQuantity quantity) {
  const auto stated = as_built(instrument, geometry, quantity);
  if (!stated) {
    return std::nullopt;
  }
  return Found{
      stated_degrees(stated->value),
      stated_degrees(stated_uncertainty(instrument, geometry, quantity).value_or(Angle()))};
}

std::optional<Found> image_offset(const Instrument& instrument, const std::string& geometry) {
  const auto theta_i = setup_found(instrument, geometry, SetupQuantity::theta_i);
  const auto theta_r = setup_found(instrument, geometry, SetupQuantity::theta_r);
  if (!theta_i || !theta_r) {
    return std::nullopt;
  }
  const double U_i = theta_i->expanded_uncertainty;
  const double U_r = theta_r->expanded_uncertainty;
  const double r = correlation_of_angles(instrument, geometry);
  return Found{theta_r->value - theta_i->value,
               std::sqrt(std::max(U_i * U_i + U_r * U_r - 2.0 * r * U_i * U_r, 0.0))};
}

/// Loss of light of the lamp over the interval of calibration, on a tile of the scale's value.
Found drift(const Instrument& instrument) {
  const Behaviour& b = instrument.behaviour;
  const double value_gu = instrument.standard.scale.value.nominal;
  const double at_calibration = lamp_factor(b, b.warm_up_s);
  const double at_end = lamp_factor(b, b.warm_up_s + b.calibration_interval_s);
  return {value_gu * (at_end / at_calibration - 1.0),
          k * value_gu * largest_uncertainty(instrument, UncertaintyComponent::drift)};
}

/// What the instrument's file says of a limited quantity; nothing if it says nothing of it.
std::optional<Found> found_of(const Instrument& instrument, const LimitRow& limit) {
  if (const auto quantity = setup_quantity(limit.quantity)) {
    return setup_found(instrument, limit.geometry, *quantity);
  }
  if (limit.quantity == "image_offset") {
    return image_offset(instrument, limit.geometry);
  }
  if (limit.quantity == "linearity") {
    return Found{instrument.behaviour.linearity,
                 k * largest_uncertainty(instrument, UncertaintyComponent::linearity)};
  }
  if (limit.quantity == "zero") {
    return Found{0.0, k * largest_uncertainty(instrument, UncertaintyComponent::zero)};
  }
  if (limit.quantity == "drift") {
    return drift(instrument);
  }
  return std::nullopt;
}

/// Whether a certificate has anything to say of that quantity: it is no reading of a sample.
bool is_of_setup(const std::string& quantity) {
  return setup_quantity(quantity) || quantity == "image_offset" || quantity == "linearity" ||
         quantity == "zero" || quantity == "drift";
}

CertificateLimit judge(const Instrument& instrument, const Clause& clause, const LimitRow& limit,
                       const JudgementRule& rule) {
  CertificateLimit judged{
      .clause = clause.id,
      .limit = limit,
      .counts = clause.level == "shall" && !limit.evidence.is_informative(),
  };
  const auto found = found_of(instrument, limit);
  if (found) {
    judged.as_built = found->value;
    judged.expanded_uncertainty = found->expanded_uncertainty;
  }
  if (!limit.low && !limit.high) {
    judged.note = clause.not_applicable.empty() ? "no limit is known" : clause.not_applicable;
  } else if (!found) {
    judged.note = "the instrument's opening is of another shape";
  } else {
    const Interval interval{.low = limit.low, .high = limit.high};
    judged.verdict = decide(found->value, rule.guard_band_factor * found->expanded_uncertainty,
                            interval, rule.rule);
    judged.probability =
        conformance_probability(found->value, found->expanded_uncertainty / k, interval);
  }
  return judged;
}

}  // namespace

std::vector<CertificateLimit> judge_limits(const Instrument& instrument, const ClauseSet& clauses,
                                           const std::vector<std::string>& geometry_ids,
                                           const JudgementRule& rule) {
  std::vector<CertificateLimit> limits;
  for (const Clause& clause : clauses.clauses) {
    for (const LimitRow& limit : clause.limits) {
      const bool is_certified =
          limit.geometry.empty() ||
          std::ranges::find(geometry_ids, limit.geometry) != geometry_ids.end();
      if (is_certified && is_of_setup(limit.quantity)) {
        limits.push_back(judge(instrument, clause, limit, rule));
      }
    }
  }
  return limits;
}

ConformanceVerdict verdict_of(const std::vector<CertificateLimit>& limits) {
  ConformanceVerdict verdict = ConformanceVerdict::not_applicable;
  for (const CertificateLimit& limit : limits) {
    if (limit.counts) {
      verdict = worse(verdict, limit.verdict);
    }
  }
  return verdict == ConformanceVerdict::not_applicable ? ConformanceVerdict::inconclusive : verdict;
}

}  // namespace gonio
