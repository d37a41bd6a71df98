#include "reports/certificate_results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "reports/certificate_budget.hpp"
#include "reports/certificate_charts.hpp"
#include "reports/certificate_words.hpp"
#include "reports/limit_words.hpp"
#include "reports/measurement_words.hpp"

namespace gonio {

namespace {

constexpr int effect_decimals = 3;  // below what any glossmeter repeats

PageList reading_list(const Certificate& certificate, const GeometryCertificate& geometry) {
  PageList list;
  for (const CertifiedReading& reading : geometry.readings) {
    const Propagated& u = reading.propagated;
    const auto value = [&](double gu) { return measured_text(gu, u.expanded_uncertainty); };
    const auto deviation = [&](double gu) {
      return signed_text(gu - reading.nominal_gu, decimals_of(u.expanded_uncertainty));
    };
    PageData data("number", fmt::format("{}", list.size() + 1));
    data.set("title", sample_title(certificate, list.size()));
    data.set("nominal", value(reading.nominal_gu));
    data.set("before", value(reading.before_adjustment_gu));
    data.set("before_deviation", deviation(reading.before_adjustment_gu));
    data.set("after", value(reading.gloss_gu));
    data.set("after_deviation", deviation(reading.gloss_gu));
    data.set("u", uncertainty_text(u.standard_uncertainty));
    data.set("U", uncertainty_text(u.expanded_uncertainty));
    data.set("k", fixed_text(u.coverage_factor, 2));
    data.set("U_monte_carlo", uncertainty_text(reading.monte_carlo.expanded_uncertainty()));
    data.set("apart", PageData(!reading.methods_agree));
    list.push_back(data);
  }
  return list;
}

std::string stated(const std::optional<double>& value, const std::string& unit) {
  return value ? number_text(*value, unit) : "";
}

double at_or_nothing(const std::vector<double>& values, std::size_t i) {
  return i < values.size() ? values[i] : std::nan("");
}

PageList effect_heads(const std::vector<const DeviationEffect*>& effects) {
  PageList heads;
  for (const DeviationEffect* effect : effects) {
    PageData data("title", component_words(effect->component));
    data.set("as_built", stated(effect->as_built, effect->unit));
    data.set("low", stated(effect->low, effect->unit));
    data.set("high", stated(effect->high, effect->unit));
    heads.push_back(data);
  }
  return heads;
}

/// Changes of each sample: a row of cells with the keys `text`, `low` and `high`.
PageList effect_rows(const std::vector<const DeviationEffect*>& effects, std::size_t samples) {
  PageList rows;
  for (std::size_t i = 0; i < samples; ++i) {
    PageList cells;
    for (const DeviationEffect* effect : effects) {
      const auto text = [&](const std::vector<double>& changes) {
        return signed_text(at_or_nothing(changes, i), effect_decimals);
      };
      PageData cell("text", text(effect->as_built_gu));
      cell.set("low", text(effect->low_gu));
      cell.set("high", text(effect->high_gu));
      cells.push_back(cell);
    }
    PageData row("number", fmt::format("{}", i + 1));
    row.set("changes", PageData(cells));
    rows.push_back(row);
  }
  return rows;
}

/// Whether the table would show anything but zeros of it.
bool is_seen(const DeviationEffect& effect) {
  constexpr double rounds_to_zero = 0.5e-3;
  return !std::all_of(effect.as_built_gu.begin(), effect.as_built_gu.end(),
                      [](double change) { return std::abs(change) < rounds_to_zero; });
}

/// Whether it has limits, and the changes at them.
bool is_bounded(const DeviationEffect& effect) {
  return !effect.low_gu.empty() || !effect.high_gu.empty();
}

void add_effects(PageData& data, const GeometryCertificate& geometry) {
  std::vector<const DeviationEffect*> all;
  std::vector<const DeviationEffect*> bounded;
  std::vector<std::string> unseen;
  for (const DeviationEffect& effect : geometry.effects) {
    if (is_seen(effect)) {
      all.push_back(&effect);
    } else {
      unseen.push_back(component_words(effect.component));
    }
    if (is_bounded(effect)) {
      bounded.push_back(&effect);
    }
  }
  data.set("effect_heads", PageData(effect_heads(all)));
  data.set("effect_rows", PageData(effect_rows(all, geometry.readings.size())));
  set_text(data, "unseen", fmt::format("{}", fmt::join(unseen, "; ")));
  set_list(data, "bound_heads", effect_heads(bounded));
  data.set("bound_rows", PageData(effect_rows(bounded, geometry.readings.size())));
}

/// Where a quantity stands in a corner: a sign, or the number if its nominal value is not known.
std::string side_text(const GeometryCertificate& geometry, const WorstCase& corner,
                      std::size_t place) {
  const double value = at_or_nothing(corner.setup, place);
  const char* name = setup_quantity_names.at(static_cast<std::size_t>(geometry.quantities[place]));
  for (const DeviationEffect& effect : geometry.effects) {
    if (effect.component == name && effect.nominal && std::isfinite(value)) {
      constexpr double same_deg = 1e-9;
      const double deviation = value - *effect.nominal;
      return std::abs(deviation) < same_deg ? "0" : deviation < 0.0 ? "\u2212" : "+";
    }
  }
  return number_text(value);
}

PageList worst_rows(const GeometryCertificate& geometry) {
  PageList rows;
  for (const CertifiedReading& reading : geometry.readings) {
    PageList corners;
    for (std::size_t i = 0; i < geometry.quantities.size(); ++i) {
      corners.push_back(
          PageData("text", fmt::format("{} / {}", side_text(geometry, reading.lowest, i),
                                       side_text(geometry, reading.highest, i))));
    }
    PageData row("number", fmt::format("{}", rows.size() + 1));
    row.set("lowest", signed_text(reading.lowest.change_gu, effect_decimals));
    row.set("highest", signed_text(reading.highest.change_gu, effect_decimals));
    row.set("corners", PageData(corners));
    rows.push_back(row);
  }
  return rows;
}

PageList quantity_list(const GeometryCertificate& geometry) {
  std::vector<std::string> names;
  for (const SetupQuantity quantity : geometry.quantities) {
    names.push_back(component_words(setup_quantity_names.at(static_cast<std::size_t>(quantity))));
  }
  return text_list(names);
}

PageList line_list(const Certificate& certificate, const GeometryCertificate& geometry,
                   const CertifiedReading& reading) {
  PageList list;
  for (const BudgetLine& line : main_budget_lines(certificate, geometry, reading)) {
    const Distribution& distribution = line.input->distribution;
    const std::string& unit = line.input->unit;
    const std::string per = unit.empty() ? "" : fmt::format("/{}", unit);
    PageData data("component", component_words(line.input->component));
    data.set("u", fmt::format("{} {}", input_text(distribution.standard_uncertainty), unit));
    data.set("distribution", distribution_text(distribution));
    data.set("sensitivity", fmt::format("{:.4g} {}{}", line.contribution->sensitivity,
                                        certificate.standard.scale.unit, per));
    data.set("contribution", uncertainty_text(line.contribution->contribution));
    data.set("share", fixed_text(100.0 * line.contribution->share, 1));
    list.push_back(data);
  }
  return list;
}

PageList budget_list(const CertificateReport& report, const GeometryCertificate& geometry) {
  PageList list;
  for (const ShownBudget& shown : shown_budgets(report, geometry)) {
    const CertifiedReading& reading = geometry.readings.at(shown.sample);
    const Propagated& propagated = reading.propagated;
    PageData data("title", sample_title(report.certificate, shown.sample));
    set_text(data, "why", shown.why);
    data.set("u", uncertainty_text(propagated.standard_uncertainty));
    data.set("U", uncertainty_text(propagated.expanded_uncertainty));
    data.set("k", fixed_text(propagated.coverage_factor, 2));
    data.set("freedom", freedom_text(propagated.degrees_of_freedom));
    data.set("lines", PageData(line_list(report.certificate, geometry, reading)));
    list.push_back(data);
  }
  return list;
}

}  // namespace

PageData geometry_data(Figures& figures, const CertificateReport& report,
                       const GeometryCertificate& geometry) {
  const Certificate& certificate = report.certificate;
  PageData data("id", geometry.id);
  data.set("readings", PageData(reading_list(certificate, geometry)));
  data.set("surrogate", surrogate_words(certificate, geometry));
  data.set("has_apart",
           PageData(std::any_of(geometry.readings.begin(), geometry.readings.end(),
                                [](const CertifiedReading& r) { return !r.methods_agree; })));
  PageList charts;
  PageList budget_chart;
  if (!geometry.readings.empty()) {
    charts.push_back(deviation_figure(figures, certificate, geometry));
    if (std::any_of(geometry.effects.begin(), geometry.effects.end(), is_bounded)) {
      charts.push_back(worst_case_figure(figures, geometry));
    }
    budget_chart.push_back(budget_figure(figures, certificate, geometry));
  }
  set_list(data, "charts", charts);
  data.set("budget_chart", PageData(budget_chart));
  add_effects(data, geometry);
  data.set("quantities", PageData(quantity_list(geometry)));
  data.set("worst_rows", PageData(worst_rows(geometry)));
  data.set("budgets", PageData(budget_list(report, geometry)));
  return data;
}

}  // namespace gonio
