#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "emulator/quality/batch.hpp"
#include "emulator/quality/panel_source.hpp"
#include "emulator/quality/reading_uncertainty.hpp"

namespace gonio {

/// The probability that a plan accepts a lot of a product that is normal in the one channel that
/// has to keep limits, in closed form or with integrals over normal distributions, to 1e-9.
///
/// A panel's mean is the mean of the product, plus what its lot is off, plus what its instrument
/// errs by in that lot, plus what it varies by itself and its readings scatter. Given the first
/// three, panels are independent: those by attributes are binomial. The mean of all is normal; a
/// plan by variables with one limit follows the noncentral t distribution.
class AcceptanceProbability {
 public:
  /// Both must outlive this object.
  AcceptanceProbability(const Batch& batch, const ReadingUncertainties& uncertainties,
                        std::uint32_t channel);

  /// binomial, normal, noncentral t; empty if there is no closed form: with several limits or
  /// haze, where the standard selects, for a plan by variables with two limits or with instruments
  /// that err apart.
  [[nodiscard]] const std::string& closed_form() const { return closed_form_; }
  /// Nothing also where the reading rule has a say: it would ask for more readings, or reject, more
  /// than one panel in a million.
  /// @param bias  by instrument, of all its readings; empty: none.
  [[nodiscard]] std::optional<double> operator()(const NormalComponents& product,
                                                 const std::vector<double>& bias = {}) const;

 private:
  /// The panels of a lot that one instrument reads.
  struct Share {
    std::size_t instrument = 0;
    std::uint64_t panels = 0;
    double bias = 0.0;
  };
  using Shares = std::vector<Share>;

  [[nodiscard]] Shares shares_from(std::uint64_t first_panel) const;
  [[nodiscard]] bool instruments_err_apart() const;
  [[nodiscard]] std::string name() const;
  [[nodiscard]] Interval acceptance(double expanded_uncertainty) const;
  [[nodiscard]] const ReadingUncertainty& of(std::size_t instrument) const;
  [[nodiscard]] double panel_spread(const NormalComponents& product) const;
  [[nodiscard]] double largest_error() const;
  [[nodiscard]] double least_range(const NormalComponents& product) const;
  [[nodiscard]] bool rule_has_a_say(const NormalComponents& product) const;
  [[nodiscard]] std::vector<double> refused_panels(const NormalComponents& product,
                                                   const Share& share, double lot) const;
  [[nodiscard]] double by_attributes(const NormalComponents& product, const Shares& shares) const;
  [[nodiscard]] double by_mean(const NormalComponents& product, const Shares& shares) const;
  [[nodiscard]] double by_variables(const NormalComponents& product, double bias) const;

  const Batch& batch_;
  const ReadingUncertainties& uncertainties_;
  std::uint32_t channel_;
  double readings_ = 1.0;             // of a panel
  std::vector<Shares> phases_ = {};   // with which appraiser a lot may begin, each as often
  double largest_uncertainty_ = 0.0;  // U
  std::string closed_form_ = {};
};

}  // namespace gonio
