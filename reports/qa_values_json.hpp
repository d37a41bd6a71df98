#pragma once

#include "emulator/quality/qa_result.hpp"
#include "reports/json_values.hpp"

// Parts of JSON that reports of QA share. Only writers of JSON include it.

namespace gonio {

[[nodiscard]] nlohmann::ordered_json json_of(const Interval& limits);
[[nodiscard]] nlohmann::ordered_json json_of(const BatchChannel& channel);
/// All that has to be known to compute the run again, but for the text of its batch file.
[[nodiscard]] nlohmann::ordered_json json_of(const RunRecord& run);
[[nodiscard]] nlohmann::ordered_json json_of(const ControlChart& chart);
[[nodiscard]] nlohmann::ordered_json json_of(const ControlCharts::Result& charts);
[[nodiscard]] nlohmann::ordered_json json_of(const ChannelSummary& channel);
/// With the channel that it is of.
[[nodiscard]] nlohmann::ordered_json json_of(const ChannelGauge& gauge,
                                             const BatchChannel& channel);

template <class Item>
nlohmann::ordered_json json_list(const std::vector<Item>& items) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Item& item : items) {
    list.push_back(json_of(item));
  }
  return list;
}

}  // namespace gonio
