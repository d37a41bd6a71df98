#include "reports/brdf_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "reports/json_values.hpp"
#include "reports/text_table.hpp"

namespace gonio {

namespace {

using nlohmann::ordered_json;

/// Channels that stand in tables for people: all, or the first, middle and last.
std::vector<std::size_t> shown_channels(std::size_t n) {
  if (n <= 4) {
    std::vector<std::size_t> all(n);
    for (std::size_t i = 0; i < n; ++i) {
      all[i] = i;
    }
    return all;
  }
  return {0, n / 4, n / 2, 3 * n / 4, n - 1};
}

std::string channels_text(const std::vector<BrdfChannel>& channels) {
  if (channels.size() > 4) {
    return fmt::format("{}, from {} to {}", channels.size(), channel_name(channels.front()),
                       channel_name(channels.back()));
  }
  std::string text;
  for (const BrdfChannel& channel : channels) {
    text += (text.empty() ? "" : ", ") + channel_name(channel);
  }
  return text;
}

}  // namespace

std::string brdf_text(const BrdfSummary& summary) {
  TextTable facts({"File", summary.file});
  facts.add({"Format", std::string(brdf_format_name(summary.format))});
  if (!summary.description.empty()) {
    facts.add({"Description", summary.description});
  }
  facts.add({"Channels", channels_text(summary.channels)});
  facts.add({"Measured to", fmt::format("{:.4g} deg", summary.largest_theta.degrees())});
  const std::vector<std::size_t> shown = shown_channels(summary.channels.size());
  std::vector<std::string> heads{">theta_i deg", ">step deg"};
  for (const std::size_t channel : shown) {
    heads.push_back(">rho " + channel_name(summary.channels[channel]));
  }
  TextTable table(heads);
  for (const BrdfSummary::Row& row : summary.rows) {
    std::vector<std::string> cells{fmt::format("{:.4g}", row.theta_i.degrees()),
                                   fmt::format("{:.3g}", row.step.degrees())};
    for (const std::size_t channel : shown) {
      cells.push_back(fmt::format("{:.4f}", row.reflectance[Eigen::Index(channel)]));
    }
    table.add(cells);
  }
  std::string text = facts.text() + "\n" + table.text() +
                     "\nrho: directional-hemispherical reflectance; step: between directions about "
                     "the mirror direction\n";
  for (const std::string& warning : summary.warnings) {
    text += "warning: " + warning + "\n";
  }
  return text;
}

std::string brdf_json(const BrdfSummary& summary) {
  ordered_json json{{"schema", "gonio/brdf/1"},
                    {"file", summary.file},
                    {"format", brdf_format_name(summary.format)},
                    {"description", summary.description},
                    {"channels", ordered_json::array()},
                    {"largest_theta_deg", summary.largest_theta.degrees()},
                    {"incidences", ordered_json::array()},
                    {"warnings", summary.warnings}};
  for (const BrdfChannel& channel : summary.channels) {
    json["channels"].push_back(channel_name(channel));
  }
  for (const BrdfSummary::Row& row : summary.rows) {
    json["incidences"].push_back({{"theta_i_deg", row.theta_i.degrees()},
                                  {"step_deg", row.step.degrees()},
                                  {"reflectance", json_of(row.reflectance)}});
  }
  return json_text(json);
}

}  // namespace gonio
