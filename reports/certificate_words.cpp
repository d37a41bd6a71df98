#include "reports/certificate_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "emulator/core/quantity.hpp"
#include "reports/conformance_words.hpp"
#include "reports/limit_words.hpp"
#include "reports/measurement_words.hpp"

namespace gonio {

namespace {

/// To a digit more than its uncertainty has, if that leaves it on its side of the limits.
double rounded(double value, const Observation& observation) {
  const double U = observation.expanded_uncertainty;
  if (!std::isfinite(value) || !(U > 0.0)) {
    return value;
  }
  const std::string text = fixed_text(value, decimals_of(U) + 1);
  const double found = parse_quantity(text, Dimension::number).value_or(value);
  const bool is_same_side =
      (found < observation.low.value_or(found)) == (value < observation.low.value_or(value)) &&
      (found > observation.high.value_or(found)) == (value > observation.high.value_or(value));
  return is_same_side ? found : value;
}

std::vector<std::string> counted_limits(const Certificate& certificate,
                                        ConformanceVerdict verdict) {
  std::vector<std::string> names;
  for (const CertificateLimit& limit : certificate.limits) {
    if (limit.counts && limit.verdict == verdict) {
      names.push_back(limit_name(limit.limit));
    }
  }
  return names;
}

/// ": a, b" or nothing.
std::string listed(const std::vector<std::string>& names) {
  return names.empty() ? "" : fmt::format(": {}", fmt::join(names, ", "));
}

/// "60: a, b; 85: c" of the readings for which `is_one` holds; empty if it never does.
template <class Predicate>
std::string readings_where(const Certificate& certificate, Predicate is_one) {
  std::vector<std::string> parts;
  for (const GeometryCertificate& geometry : certificate.geometries) {
    std::vector<std::string> samples;
    for (std::size_t i = 0; i < geometry.readings.size(); ++i) {
      if (is_one(geometry.readings[i])) {
        samples.push_back(sample_id(certificate, i));
      }
    }
    if (!samples.empty()) {
      parts.push_back(fmt::format("{} at {}", fmt::join(samples, ", "), geometry.id));
    }
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) {
    most = std::isnan(value) ? value : std::max(most, std::abs(value));
  }
  return most;
}

/// The largest of the samples that were read by way of it.
double surrogate_error(const GeometryCertificate& geometry) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < geometry.surrogate_error_gu.size(); ++i) {
    if (!is_read_directly(geometry, i)) {
      errors.push_back(geometry.surrogate_error_gu[i]);
    }
  }
  return largest(errors);
}

std::string surrogate_error_words(const GeometryCertificate& geometry) {
  return fmt::format("Monte Carlo used a surrogate of the optics, which errs by {} GU at most",
                     uncertainty_text(surrogate_error(geometry)));
}

void warn_of_methods(const Certificate& certificate, std::vector<std::string>& sentences) {
  const std::string apart =
      readings_where(certificate, [](const CertifiedReading& r) { return !r.methods_agree; });
  if (!apart.empty()) {
    sentences.push_back(fmt::format(
        "The law of propagation and Monte Carlo do not agree on {}: the measurement is not linear "
        "there, or what makes it uncertain not normal. The interval of Monte Carlo is the one to "
        "use.",
        apart));
  }
  if (!certificate.is_stable && certificate.trials > 0) {
    sentences.push_back(fmt::format("Monte Carlo is not stable to two digits after {} trials.",
                                    certificate.trials));
  }
  for (const GeometryCertificate& geometry : certificate.geometries) {
    constexpr double enough_gu = 1e-3;
    if (!(surrogate_error(geometry) < enough_gu)) {
      sentences.push_back(fmt::format(
          "Geometry {}: the surrogate of the optics errs by {} GU, more than {} GU.", geometry.id,
          uncertainty_text(largest(geometry.surrogate_error_gu)), number_text(enough_gu)));
    }
  }
}

void warn_of_estimates(const Certificate& certificate, std::vector<std::string>& sentences) {
  constexpr double unlikely = 0.05;
  for (const SetupEstimate& estimate : certificate.estimates) {
    if (!estimate.has_converged) {
      sentences.push_back(
          fmt::format("Geometry {}: the search for the set-up behind the readings came to no end.",
                      estimate.geometry));
    } else if (estimate.p_value < unlikely) {
      sentences.push_back(fmt::format(
          "Geometry {}: no set-up near the one assumed explains the readings.", estimate.geometry));
    }
  }
}

/// What the readings tell of a limited quantity, as if it had been stated.
std::optional<CertificateLimit> as_estimated(const Certificate& certificate,
                                             const std::string& geometry,
                                             const EstimatedParameter& parameter) {
  for (CertificateLimit limit : certificate.limits) {
    if (limit.limit.geometry == geometry && limit.limit.quantity == parameter.name &&
        (limit.limit.low || limit.limit.high)) {
      constexpr double k = 2.0;
      limit.as_built = parameter.estimate;
      limit.expanded_uncertainty = k * parameter.standard_uncertainty;
      limit.verdict =
          decide(parameter.estimate, certificate.guard_band_factor * limit.expanded_uncertainty,
                 {.low = limit.limit.low, .high = limit.limit.high}, certificate.decision_rule);
      return limit;
    }
  }
  return std::nullopt;
}

/// Limits that are met by what is stated, but not by what the readings tell.
void warn_of_estimated_limits(const Certificate& certificate, std::vector<std::string>& sentences) {
  for (const SetupEstimate& estimate : certificate.estimates) {
    for (const EstimatedParameter& parameter : estimate.parameters) {
      const auto limit = parameter.is_determined
                             ? as_estimated(certificate, estimate.geometry, parameter)
                             : std::nullopt;
      if (limit && limit->verdict == ConformanceVerdict::fail) {
        sentences.push_back(fmt::format("The readings tell that a limit is not met: {}.",
                                        observation_text(observation_of(*limit))));
      }
    }
  }
}

}  // namespace

std::string certificate_meaning(const Certificate& certificate) {
  std::string none = "No limit that counts could be judged.";
  const std::string limits = listed(counted_limits(certificate, certificate.verdict));
  switch (certificate.verdict) {
    case ConformanceVerdict::pass:
      return "Every limit that counts is met by the set-up as stated.";
    case ConformanceVerdict::fail:
      return fmt::format("At least one limit that counts is not met{}.", limits);
    case ConformanceVerdict::inconclusive:
      return limits.empty()
                 ? none
                 : fmt::format("At a limit, the uncertainty is too large to tell{}.", limits);
    default:
      return none;
  }
}

std::vector<std::string> certificate_warnings(const Certificate& certificate) {
  std::vector<std::string> sentences;
  const std::string& transcription = certificate.standard.transcription;
  if (transcription != "complete") {
    sentences.push_back(
        fmt::format("The transcription of this standard is {}: no claim of conformity may be made.",
                    transcription.empty() ? "not stated" : transcription));
  }
  const auto informative =
      std::count_if(certificate.limits.begin(), certificate.limits.end(),
                    [](const CertificateLimit& limit) { return !limit.counts; });
  if (informative > 0) {
    sentences.push_back(fmt::format("{} limit{} known only from memory: informative, not counted.",
                                    informative, informative == 1 ? "" : "s"));
  }
  warn_of_methods(certificate, sentences);
  warn_of_estimates(certificate, sentences);
  warn_of_estimated_limits(certificate, sentences);
  return sentences;
}

std::string decision_words(const Certificate& certificate) {
  const std::string words = decision_rule_words(certificate.decision_rule);
  return certificate.decision_rule == DecisionRule::guarded && certificate.guard_band_factor != 1.0
             ? fmt::format("{}; the guard band is {} U", words,
                           number_text(certificate.guard_band_factor))
             : words;
}

std::string simulation_words() {
  return "This certificate is of a simulated instrument, or of a set-up as its file states it. "
         "Nobody measured it, and no accreditation is claimed.";
}

Observation observation_of(const CertificateLimit& limit) {
  const std::string two_digits = fmt::format("{:.2g}", limit.expanded_uncertainty);
  const LimitRow& row = limit.limit;
  Observation observation{
      .quantity = row.quantity,
      .geometry = row.geometry,
      .unit = row.unit,
      .found = limit.as_built ? "" : "not stated",
      .value = limit.as_built,
      .expanded_uncertainty =
          parse_quantity(two_digits, Dimension::number).value_or(limit.expanded_uncertainty),
      .expected = row.nominal,
      .low = row.low,
      .high = row.high,
      .verdict = limit.verdict,
      .note = limit.note};
  if (row.nominal && row.tolerance) {
    observation.low = row.low.value_or(*row.nominal - *row.tolerance);
    observation.high = row.high.value_or(*row.nominal + *row.tolerance);
  }
  if (observation.value) {
    observation.value = rounded(*observation.value, observation);
  }
  return observation;
}

std::string sample_id(const Certificate& certificate, std::size_t sample) {
  return sample < certificate.samples.size() ? certificate.samples[sample]
                                             : fmt::format("sample {}", sample + 1);
}

std::string sample_title(const Certificate& certificate, std::size_t sample) {
  return sample < certificate.sample_titles.size() && !certificate.sample_titles[sample].empty()
             ? certificate.sample_titles[sample]
             : sample_id(certificate, sample);
}

std::string verdict_of(const CertificateLimit& limit) {
  return limit.counts ? verdict_words(limit.verdict)
                      : fmt::format("{}, not counted", verdict_words(limit.verdict));
}

std::string freedom_text(double degrees_of_freedom) {
  return std::isfinite(degrees_of_freedom) ? fmt::format("{:.0f}", degrees_of_freedom)
                                           : number_text(degrees_of_freedom);
}

std::string input_text(double standard_uncertainty) {
  return fmt::format("{:.3g}", standard_uncertainty);
}

std::string corner_text(const GeometryCertificate& geometry, const WorstCase& corner) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < std::min(geometry.quantities.size(), corner.setup.size()); ++i) {
    parts.push_back(fmt::format("{} {}",
                                setup_quantity_names.at(std::size_t(geometry.quantities[i])),
                                number_text(corner.setup[i], "deg")));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

bool is_read_directly(const GeometryCertificate& geometry, std::size_t sample) {
  const auto& direct = geometry.direct_samples;
  return std::find(direct.begin(), direct.end(), sample) != direct.end();
}

std::string surrogate_words(const Certificate& certificate, const GeometryCertificate& geometry) {
  std::vector<std::string> direct;
  for (const std::size_t sample : geometry.direct_samples) {
    direct.push_back(sample_id(certificate, sample));
  }
  const std::string through = fmt::format(
      "Monte Carlo went through the optics themselves for {}, with {} trials",
      direct.size() < geometry.readings.size() ? fmt::format("{}", fmt::join(direct, ", "))
                                               : "all samples",
      certificate.direct_trials);
  return direct.empty() ? surrogate_error_words(geometry)
         : direct.size() < geometry.readings.size()
             ? surrogate_error_words(geometry) + "; " + through
             : through;
}

std::string fit_words(const SetupEstimate& estimate) {
  return fmt::format("{} reading{}; chi squared {} for {} degrees of freedom, p = {}{}.",
                     estimate.readings.size(), estimate.readings.size() == 1 ? "" : "s",
                     number_text(estimate.chi_squared), estimate.degrees_of_freedom,
                     number_text(std::round(1e4 * estimate.p_value) / 1e4),
                     estimate.has_converged ? "" : "; the search has not converged");
}

std::string confusion_words(const SetupEstimate& estimate, const Confusion& confusion) {
  constexpr double counts = 0.2;  // of a direction of length 1: smaller parts do not matter
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < std::min(estimate.parameters.size(), confusion.direction.size());
       ++i) {
    if (std::abs(confusion.direction[i]) >= counts) {
      parts.push_back(fmt::format("{} ({})", estimate.parameters[i].name,
                                  signed_text(confusion.direction[i], 2)));
    }
  }
  const std::string left = fmt::format("{:.0f} %", 100.0 * confusion.remaining);
  return parts.size() == 1 ? fmt::format("The readings leave {} of the uncertainty of {}.", left,
                                         parts.front().substr(0, parts.front().rfind(" (")))
                           : fmt::format(
                                 "The readings do not tell apart {}: {} of the uncertainty of this "
                                 "combination is left.",
                                 fmt::join(parts, ", "), left);
}

}  // namespace gonio
