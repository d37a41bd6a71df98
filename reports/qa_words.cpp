#include "reports/qa_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "emulator/quality/batch.hpp"

namespace gonio {

namespace {

std::string text_or(const std::string& text, const std::string& other) {
  return text.empty() ? other : text;
}

std::string verdict_counts(std::uint64_t passed, std::uint64_t failed, std::uint64_t inconclusive,
                           const std::array<const char*, 3>& words) {
  return fmt::format("{} {}, {} {}, {} {}", passed, words[0], failed, words[1], inconclusive,
                     words[2]);
}

/// e.g. "1 is", "2 are".
std::string is_or_are(std::uint64_t count) {
  return fmt::format("{} {}", count, count == 1 ? "is" : "are");
}

std::string percent_of(double risk) { return fmt::format("{:g} %", 100.0 * risk); }

}  // namespace

std::string channel_words(const BatchChannel& channel) {
  switch (channel.kind) {
    case BatchChannel::Kind::gloss:
      return fmt::format("gloss at {}", text_or(channel.geometry, channel.id));
    case BatchChannel::Kind::colour_difference:
      return fmt::format("colour difference at {}", text_or(channel.geometry, channel.id));
    case BatchChannel::Kind::haze:
      break;
  }
  return fmt::format("haze ({})", channel.id);
}

std::string in_unit(const BatchChannel& channel) {
  return channel.unit.empty() ? "" : fmt::format(", in {}", channel.unit);
}

std::string limits_words(const Interval& limits, const std::optional<double>& target,
                         const std::string& unit) {
  if (!limits.low && !limits.high) {
    return "none";
  }
  const std::optional<double> middle =
      limits.low && limits.high ? std::optional(0.5 * (*limits.low + *limits.high)) : std::nullopt;
  LimitRow row{};
  row.nominal = target ? target : middle;
  row.low = limits.low;
  row.high = limits.high;
  row.unit = unit;
  return limit_text(row);
}

std::string limits_words(const ChannelSummary& channel) {
  return limits_words(channel.limits, channel.target, channel.channel.unit);
}

std::string uniformity_words(std::size_t panel_verdict) {
  constexpr std::array words{"uniform", "more readings wanted", "not uniform", "rejected"};
  return words.at(panel_verdict);
}

std::string rule_words(int rule) {
  constexpr std::array words{"a point beyond 3 sigma", "2 of 3 beyond 2 sigma on one side",
                             "4 of 5 beyond 1 sigma on one side", "8 in a row on one side"};
  return words.at(std::size_t(std::clamp(rule, 1, int(words.size())) - 1));
}

std::string closed_form_words(const OcCurve& curve) {
  return curve.parameter == "mean" ? "Closed form" : "Normal model";
}

std::string parameter_words(const std::string& parameter) {
  std::string words = parameter;
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

double parameter_scale(const std::string& parameter) {
  return parameter == sample_parameter_names.front() ? 100.0 : 1.0;
}

std::string parameter_text(const std::string& parameter, double value) {
  const double scale = parameter_scale(parameter);
  return std::isfinite(value)
             ? fmt::format("{:.3g}{}", scale * value + 0.0, scale == 1.0 ? "" : " %")
             : "-";
}

std::string qa_meaning(const QaResult& result) {
  const std::uint64_t lots = result.lots_accepted + result.lots_refused + result.lots_inconclusive;
  switch (result.verdict) {
    case ConformanceVerdict::pass:
      return fmt::format("Of {} inspected {}: as many as have to be.", count_text(lots, "lot"),
                         result.lots_accepted == lots
                             ? "all are accepted"
                             : fmt::format("{} accepted", is_or_are(result.lots_accepted)));
    case ConformanceVerdict::fail:
      return fmt::format("Of {} inspected {} refused: more than may be.", count_text(lots, "lot"),
                         is_or_are(result.lots_refused));
    case ConformanceVerdict::inconclusive:
      return fmt::format(
          "Of {} inspected {}: the uncertainty of the readings reaches over a limit.",
          count_text(lots, "lot"),
          result.lots_inconclusive == 1
              ? "1 can neither be accepted nor refused"
              : fmt::format("{} can neither be accepted nor refused", result.lots_inconclusive));
    case ConformanceVerdict::not_applicable:
      return "Nothing was judged: no limit applies to what was read.";
    case ConformanceVerdict::skipped:
    case ConformanceVerdict::error:
      break;
  }
  return "Nothing could be judged.";
}

std::string panel_counts(const QaResult& result) {
  return fmt::format("{}: {}", count_text(result.panels, "panel"),
                     verdict_counts(result.panels_passed, result.panels_failed,
                                    result.panels_inconclusive, {"pass", "fail", "inconclusive"}));
}

std::string lot_counts(const QaResult& result) {
  return fmt::format(
      "{}: {}",
      count_text(result.lots_accepted + result.lots_refused + result.lots_inconclusive, "lot"),
      verdict_counts(result.lots_accepted, result.lots_refused, result.lots_inconclusive,
                     {"accepted", "refused", "inconclusive"}));
}

std::string extent_words(const QaResult& result) {
  return fmt::format("{}, {}, {}, {}", count_text(result.run.lots, "lot"),
                     count_text(result.panels, "panel"), count_text(result.readings, "reading"),
                     count_text(result.channels.size(), "channel"));
}

std::string rules_words() {
  std::vector<std::string> rules;
  for (int rule = 1; rule <= int(western_electric_rules); ++rule) {
    rules.push_back(fmt::format("rule {}: {}", rule, rule_words(rule)));
  }
  return fmt::format("{}", fmt::join(rules, "; "));
}

std::string control_words(const ControlChart& chart, const std::string& point) {
  if (!(chart.sigma > 0.0)) {
    return "no rule asked: the baseline knows no spread";
  }
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < western_electric_rules; ++i) {
    if (chart.signals[i] == 0) {
      continue;
    }
    const int rule = int(i) + 1;
    const auto first =
        std::find_if(chart.first_signals.begin(), chart.first_signals.end(),
                     [&](const ControlSignal& signal) { return signal.rule == rule; });
    parts.push_back(
        fmt::format("rule {} {}{}", rule, times_words(chart.signals[i]),
                    first == chart.first_signals.end()
                        ? ""
                        : fmt::format(", {} {} {}", chart.signals[i] == 1 ? "at" : "first at",
                                      point, first->point)));
  }
  return parts.empty() ? "in control" : fmt::format("not in control: {}", fmt::join(parts, "; "));
}

std::vector<NamedChart> named_charts(const ControlCharts::Result& charts) {
  std::vector<NamedChart> named;
  if (charts.mean) {
    named.push_back({"X-bar", &*charts.mean});
  }
  if (charts.range) {
    named.push_back({"R", &*charts.range});
  }
  if (charts.individual.points > 0) {
    named.push_back({"I", &charts.individual});
  }
  if (charts.moving_range.points > 0) {
    named.push_back({"MR", &charts.moving_range});
  }
  return named;
}

std::uint64_t rejected_by_rule(const ChannelSummary& channel) {
  return channel.uniformity[std::size_t(PanelVerdict::not_uniform)] +
         channel.uniformity[std::size_t(PanelVerdict::rejected)];
}

BatchChannel channel_at(const QaResult& result, std::uint32_t channel) {
  if (channel < result.channels.size()) {
    return result.channels[channel].channel;
  }
  const std::string id = fmt::format("{}", channel);
  return {.id = id, .geometry = id, .kind = BatchChannel::Kind::gloss, .unit = {}};
}

double mean_of_positions(const ChannelSummary& channel) {
  double sum = 0.0;
  double readings = 0.0;
  for (const PositionSummary& position : channel.positions) {
    sum += double(position.readings) * position.mean;
    readings += double(position.readings);
  }
  return readings > 0.0 ? sum / readings : 0.0;
}

std::vector<GaugeComponent> gauge_components(const GaugeStudy& study) {
  const auto component = [&](const char* name, double sd) {
    GaugeComponent part{name, sd, 100.0 * sd / study.sd_total, {}};
    if (study.percent_of_tolerance) {
      part.percent_of_tolerance = *study.percent_of_tolerance * sd / study.sd_gauge;
    }
    return part;
  };
  return {component("gauge R&R", study.sd_gauge),
          component("repeatability", study.sd_repeatability),
          component("reproducibility", study.sd_reproducibility),
          component("appraisers", study.sd_appraiser),
          component("interaction", study.sd_interaction),
          component("panels", study.sd_part),
          component("all", study.sd_total)};
}

std::string percent_text(const std::optional<double>& percent) {
  return percent && std::isfinite(*percent) ? fixed_text(*percent, 1) + " %" : "-";
}

std::string gauge_words(const GaugeStudy& study) {
  constexpr double good = 10.0;
  constexpr double bearable = 30.0;
  const double percent = study.percent_of_study;
  const char* judgement = percent < good        ? "fit: below 10 % of the study variation"
                          : percent <= bearable ? "fit for some uses: 10 % to 30 %"
                                                : "not fit: above 30 % of the study variation";
  return std::isfinite(percent) ? judgement : "not known";
}

std::string risk_words(const Risks& risks) {
  return risks.from_normal_model
             ? fmt::format(
                   "From {} with {} simulated by normal distributions of the spread that was "
                   "measured",
                   count_text(risks.lots, "lot"), count_text(risks.panels, "panel"))
             : fmt::format("From {} with {} simulated as the batch file states",
                           count_text(risks.lots, "lot"), count_text(risks.panels, "panel"));
}

std::string answer_words(const ReadingsAnswer& answer) {
  const std::string risk = percent_of(answer.risk);
  if (answer.needed) {
    return fmt::format("{} of a panel {} both risks of a lot below {} (now {}).",
                       count_text(*answer.needed, "reading"),
                       *answer.needed == 1 ? "keeps" : "keep", risk, answer.present);
  }
  const auto most =
      std::max_element(answer.rows.begin(), answer.rows.end(),
                       [](const auto& a, const auto& b) { return a.readings < b.readings; });
  return fmt::format(
      "No number of readings of a panel that was tried{} keeps both risks of a lot "
      "below {} (now {}).",
      most == answer.rows.end() ? "" : fmt::format(", up to {},", most->readings), risk,
      answer.present);
}

std::string answer_words(const SpreadAnswer& answer) {
  const std::string name = parameter_words(answer.parameter);
  const auto text = [&](double value) { return parameter_text(answer.parameter, value); };
  const std::string risk = percent_of(answer.risk);
  if (answer.unlimited) {
    return fmt::format(
        "No spread of {} that was tried{} has more than {} of the lots refused (now "
        "{}).",
        name,
        answer.rows.empty() ? "" : fmt::format(", up to {},", text(answer.rows.back().spread)),
        risk, text(answer.present));
  }
  if (!answer.allowed) {
    return fmt::format(
        "Even without any spread of {} more than {} of the lots are refused (now "
        "{}).",
        name, risk, text(answer.present));
  }
  return fmt::format(
      "The {} may vary by {} (standard deviation) until {} of the lots are refused "
      "(now {}).",
      name, text(*answer.allowed), risk, text(answer.present));
}

std::vector<std::string> answers(const QaResult& result) {
  std::vector<std::string> sentences;
  if (result.readings_answer) {
    sentences.push_back(answer_words(*result.readings_answer));
  }
  for (const SpreadAnswer& answer : result.spread_answers) {
    sentences.push_back(answer_words(answer));
  }
  return sentences;
}

}  // namespace gonio
