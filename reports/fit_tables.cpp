#include "reports/fit_tables.hpp"

#include <fmt/format.h>

#include <cmath>

namespace gonio {

namespace {

using State = FittedParameter::State;

constexpr double percent = 100.0;
/// Two parameters beyond this are told apart badly.
constexpr double close_correlation = 0.99;
/// A model is not the one of data that are so improbable if it is.
constexpr double improbable = 0.001;

std::string number_text(double value) {
  return std::isfinite(value) ? fmt::format("{:.5g}", value) : "none";
}

/// Which free parameters are correlated closely.
void add_correlations(std::vector<std::string>& warnings, const SurfaceFit& fit) {
  std::vector<std::string> free;
  for (const FittedParameter& parameter : fit.parameters) {
    if (parameter.state == State::free) {
      free.push_back(parameter.name);
    }
  }
  for (std::size_t i = 0; i < free.size(); ++i) {
    for (std::size_t j = i + 1; j < free.size(); ++j) {
      const double r = fit.correlation(Eigen::Index(i), Eigen::Index(j));
      if (std::abs(r) > close_correlation) {
        warnings.push_back(
            fmt::format("{}: {} and {} are correlated by {:.4f}; the data hardly "
                        "tell them apart.",
                        fit.model, free[i], free[j], r));
      }
    }
  }
}

void add_states(std::vector<std::string>& warnings, const SurfaceFit& fit) {
  std::string open, at_bound;
  for (const FittedParameter& parameter : fit.parameters) {
    std::string& list = parameter.state == State::open ? open : at_bound;
    if (parameter.state == State::open || parameter.state == State::at_bound) {
      list +=
          fmt::format("{}{} = {:.4g}", list.empty() ? "" : ", ", parameter.name, parameter.value);
    }
  }
  if (!open.empty()) {
    warnings.push_back(fmt::format(
        "{}: the data do not tell {} from one another; fix one of them (--fix).", fit.model, open));
  }
  if (!at_bound.empty()) {
    warnings.push_back(fmt::format(
        "{}: {} stands at its bound; nothing is said of its uncertainty, and what is said of the "
        "others holds if it is there.",
        fit.model, at_bound));
  }
}

}  // namespace

std::string state_words(State state) {
  switch (state) {
    case State::free:
      return "free";
    case State::fixed:
      return "fixed";
    case State::at_bound:
      return "at its bound";
    case State::open:
      break;
  }
  return "open";
}

std::vector<std::string> fit_method(const FitReport& report) {
  const FitObservations& observations = report.observations;
  std::vector<std::string> sentences{fmt::format(
      "{} values of {}, in {} groups{}; {}.", observations.observed.size(), observations.quantity,
      observations.groups.size(),
      report.instrument.empty() ? ""
                                : fmt::format(", through the apertures of {}", report.instrument),
      observations.weighting)};
  sentences.emplace_back(
      observations.is_u_known
          ? "Uncertainties are those of the data."
          : "The data state no uncertainties: a common one is estimated from the residuals.");
  sentences.emplace_back(
      "Intervals cover 95 %. A relative RMSE is the root of the mean squared difference over the "
      "mean of what was observed.");
  return sentences;
}

std::vector<std::string> fit_warnings(const FitReport& report) {
  std::vector<std::string> warnings;
  const double r = report.comparison.autocorrelation;
  if (r > 0.0) {
    warnings.push_back(fmt::format(
        "Neighbouring residuals of the nearest model are correlated by {:.2f}: {} values count as "
        "{:.0f} independent ones in AICc, BIC and, by its own residuals, in the uncertainties of "
        "each model.",
        r, report.observations.observed.size(), report.comparison.effective_size));
  }
  for (const SurfaceFit& fit : report.fits) {
    if (!fit.has_converged) {
      warnings.push_back(fmt::format(
          "{}: the search did not converge; its parameters are where it gave up.", fit.model));
    }
    if (report.observations.is_u_known && fit.p_value < improbable) {
      warnings.push_back(fmt::format(
          "{}: does not describe the data within their uncertainties (chi squared {:.4g} for {} "
          "values); its intervals are too narrow.",
          fit.model, fit.chi_squared, fit.residual.size()));
    }
    add_states(warnings, fit);
    add_correlations(warnings, fit);
  }
  return warnings;
}

ReportTable comparison_table(const FitReport& report) {
  ReportTable table{.caption = "Models, the best first",
                    .heads = {"model", ">parameters", ">chi squared", ">AICc", ">BIC",
                              ">Akaike weight", ">correlation"}};
  for (const RankedFit& ranked : report.comparison.ranking) {
    const SurfaceFit& fit = report.fits[ranked.fit];
    table.rows.push_back(
        {fit.model, fmt::format("{}", fit.sought), fmt::format("{:.5g}", fit.chi_squared),
         fmt::format("{:.1f}", ranked.aicc), fmt::format("{:.1f}", ranked.bic),
         fmt::format("{:.4f}", ranked.weight), fmt::format("{:.2f}", fit.autocorrelation)});
  }
  return table;
}

ReportTable parameter_table(const SurfaceFit& fit) {
  ReportTable table{.caption = fmt::format("{}: {}", fit.model, fit.title),
                    .heads = {"parameter", ">value", ">u", ">low", ">high", "state"}};
  for (const FittedParameter& parameter : fit.parameters) {
    const bool is_free = parameter.state == State::free;
    table.rows.push_back({parameter.name, number_text(parameter.value),
                          is_free ? fmt::format("{:.2g}", parameter.u) : "-",
                          is_free ? number_text(parameter.low) : "-",
                          is_free ? number_text(parameter.high) : "-",
                          state_words(parameter.state)});
  }
  return table;
}

ReportTable deviation_table(const FitReport& report) {
  ReportTable table{.caption = "Relative RMSE / %", .heads = {"model"}};
  for (const FitGroup& group : report.observations.groups) {
    table.heads.push_back(fmt::format(">{} deg", group.id));
  }
  for (const RankedFit& ranked : report.comparison.ranking) {
    const SurfaceFit& fit = report.fits[ranked.fit];
    std::vector<ReportCell> row{fit.model};
    for (const FitDeviation& deviation : fit.deviations) {
      row.emplace_back(std::isfinite(deviation.relative_rmse)
                           ? fmt::format("{:.3f}", percent * deviation.relative_rmse)
                           : "-");
    }
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace gonio
