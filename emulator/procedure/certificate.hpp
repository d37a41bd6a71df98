#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "emulator/instrument/instrument.hpp"
#include "emulator/instrument/setup.hpp"
#include "emulator/procedure/setup_estimate.hpp"
#include "emulator/standard/clause.hpp"
#include "emulator/standard/decision.hpp"
#include "emulator/uncertainty/monte_carlo.hpp"
#include "emulator/uncertainty/propagation.hpp"

namespace gonio {

/// A quantity of the instrument against its limit.
struct CertificateLimit {
  std::string clause = {};              ///< e.g. geometry/incidence_60
  LimitRow limit = {};                  ///< with its evidence and place
  std::optional<double> as_built = {};  ///< in the unit of the limit; nothing if it is not stated
  double expanded_uncertainty = 0.0;    ///< of `as_built`, k = 2
  ConformanceVerdict verdict = ConformanceVerdict::not_applicable;
  std::optional<double> probability = {};  ///< of conformance, after JCGM 106
  bool counts = true;                      ///< not if the limit is known from memory only
  std::string note = {};                   ///< why there is no verdict
};

/// An input of the measurement, for the budget.
struct CertificateInput {
  std::string id;         ///< e.g. 60/theta_i
  std::string component;  ///< e.g. theta_i
  std::string geometry;   ///< empty if it is of all
  std::string unit;       ///< deg, GU, K, or empty
  double estimate = 0.0;
  Distribution distribution = {};
};

/// What one deviation does to readings, all else as the standard says.
struct DeviationEffect {
  std::string geometry = {};
  /// Of a set-up quantity, or spectrum, polarization, linearity, tile_contamination, or `all`.
  std::string component = {};
  std::string unit = {};  ///< empty where there is no number
  std::optional<double> nominal = {}, as_built = {};
  std::optional<double> low = {}, high = {};      ///< limits
  std::vector<double> as_built_gu = {};           ///< change of the reading, by sample
  std::vector<double> low_gu = {}, high_gu = {};  ///< at the limits; empty if there are none
};

/// The largest change within the limits, over all combinations of low, nominal and high.
struct WorstCase {
  double change_gu = 0.0;
  std::vector<double> setup = {};  ///< in the order of GeometryCertificate::quantities, deg
};

/// A sample of the ladder at one geometry.
struct CertifiedReading {
  double nominal_gu = 0.0;            ///< by the set-up of the standard
  double gloss_gu = 0.0;              ///< by the set-up as built, calibrated
  double before_adjustment_gu = 0.0;  ///< before its calibration: lamp aged and tile as it is
  Propagated propagated = {};         ///< by the law of propagation
  MonteCarloOutput monte_carlo = {};
  bool methods_agree = true;                   ///< both U, and the estimates, to 5 % of U
  std::vector<double> sensitivity_error = {};  ///< against plain finite differences, by input
  WorstCase lowest = {}, highest = {};

  /// To be taken off a reading.
  [[nodiscard]] double deviation_gu() const { return gloss_gu - nominal_gu; }
};

struct GeometryCertificate {
  std::string id;
  double theta_i_deg = 0.0;
  std::vector<SetupQuantity> quantities = {};   ///< those that it has
  std::vector<DeviationEffect> effects = {};    ///< the last one is `all`
  std::vector<CertifiedReading> readings = {};  ///< by sample
  std::vector<double> surrogate_error_gu = {};  ///< largest seen, by sample
  /// Samples that Monte Carlo read through the optics themselves, since no polynomial was good
  /// enough.
  std::vector<std::size_t> direct_samples = {};
};

/// All that is known of a set-up after it was certified.
struct Certificate {
  Instrument instrument;
  Standard standard;
  DecisionRule decision_rule = DecisionRule::guarded;
  double guard_band_factor = 1.0;  ///< of U
  std::uint64_t seed = 1;
  ConformanceVerdict verdict = ConformanceVerdict::pass;
  std::vector<CertificateLimit> limits = {};
  std::vector<std::string> samples = {}, sample_titles = {};  ///< the ladder, matt to mirror
  std::vector<CertificateInput> inputs = {};
  std::vector<GeometryCertificate> geometries = {};
  double coverage = 0.95;
  std::size_t trials = 0;
  std::size_t direct_trials = 0;              ///< of the direct samples
  bool is_stable = false;                     ///< Monte Carlo, to two digits of u
  std::vector<SetupEstimate> estimates = {};  ///< from readings of tiles, by geometry
};

}  // namespace gonio
