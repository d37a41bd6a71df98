#include <nlohmann/json.hpp>

#include "reports/fit_report.hpp"
#include "reports/fit_tables.hpp"
#include "reports/json_values.hpp"

namespace gonio {

namespace {

using nlohmann::ordered_json;

/// Words of a state as ids are written.
std::string state_id(FittedParameter::State state) {
  return state == FittedParameter::State::at_bound ? "at_bound" : state_words(state);
}

ordered_json parameter_json(const FittedParameter& parameter) {
  const bool is_free = parameter.state == FittedParameter::State::free;
  const auto if_free = [&](double value) {
    return json_of(is_free ? std::optional(value) : std::nullopt);
  };
  return {{"name", parameter.name},
          {"value", parameter.value},
          {"state", state_id(parameter.state)},
          {"u", if_free(parameter.u)},
          {"low", if_free(parameter.low)},
          {"high", if_free(parameter.high)}};
}

ordered_json surface_fit_json(const SurfaceFit& fit, const RankedFit& ranked, bool is_u_known) {
  ordered_json json{{"model", fit.model},
                    {"title", fit.title},
                    {"has_converged", fit.has_converged},
                    {"aicc", ranked.aicc},
                    {"bic", ranked.bic},
                    {"akaike_weight", ranked.weight},
                    {"chi_squared", fit.chi_squared},
                    {"p_value", json_of(is_u_known ? std::optional(fit.p_value) : std::nullopt)},
                    {"sigma", fit.sigma},
                    {"autocorrelation", fit.autocorrelation},
                    {"effective_size", fit.effective_size},
                    {"parameters", ordered_json::array()},
                    {"correlation", ordered_json::array()},
                    {"groups", ordered_json::array()},
                    {"fitted", json_of(fit.fitted.array())}};
  for (const FittedParameter& parameter : fit.parameters) {
    json["parameters"].push_back(parameter_json(parameter));
  }
  for (Eigen::Index i = 0; i < fit.correlation.rows(); ++i) {
    json["correlation"].push_back(json_of(fit.correlation.row(i).array()));
  }
  for (const FitDeviation& deviation : fit.deviations) {
    json["groups"].push_back({{"id", deviation.group},
                              {"rmse", deviation.rmse},
                              {"relative_rmse", deviation.relative_rmse}});
  }
  return json;
}

}  // namespace

std::string fit_json(const FitReport& report) {
  const FitObservations& observations = report.observations;
  ordered_json json{{"schema", "gonio/fit/1"},
                    {"title", report.title},
                    {"data", observations.file},
                    {"instrument", report.instrument.empty() ? ordered_json(nullptr)
                                                             : ordered_json(report.instrument)},
                    {"refractive_index", report.index},
                    {"quantity", observations.quantity},
                    {"abscissa", observations.abscissa},
                    {"weighting", observations.weighting},
                    {"autocorrelation", report.comparison.autocorrelation},
                    {"effective_size", report.comparison.effective_size},
                    {"groups", ordered_json::array()},
                    {"models", ordered_json::array()},
                    {"warnings", fit_warnings(report)}};
  for (const FitGroup& group : observations.groups) {
    json["groups"].push_back(
        {{"id", group.id},
         {"abscissa", json_of(group.abscissa)},
         {"observed", json_of(observations.observed.segment(group.first, group.size()).array())}});
  }
  for (const RankedFit& ranked : report.comparison.ranking) {
    json["models"].push_back(
        surface_fit_json(report.fits[ranked.fit], ranked, observations.is_u_known));
  }
  return json_text(json);
}

}  // namespace gonio
