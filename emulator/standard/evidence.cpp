#include "emulator/standard/evidence.hpp"

#include <algorithm>

namespace gonio {

namespace {

const std::vector<std::string>& evidence_levels() {
  static const std::vector<std::string> levels{"C2",   "C1+calc", "C1",
                                               "calc", "memory",  "memory-low"};
  return levels;
}

}  // namespace

bool Evidence::is_informative() const { return level == "memory" || level == "memory-low"; }

const Evidence& Evidence::weaker(const Evidence& a, const Evidence& b) {
  const auto& levels = evidence_levels();
  return std::find(levels.begin(), levels.end(), a.level) <
                 std::find(levels.begin(), levels.end(), b.level)
             ? b
             : a;
}

Evidence read_evidence(const YamlNode& node) {
  return node.read_map([](YamlMap& map) {
    Evidence evidence;
    evidence.level = map.required("level").choice(evidence_levels());
    for (const YamlNode& source : map.required("sources").list_or_empty()) {
      evidence.sources.push_back(source.text());
    }
    return evidence;
  });
}

Stated<double> read_stated_number(const YamlNode& node, const Range& range) {
  return read_stated<double>(node, [&](const YamlNode& value, bool is_tolerance) {
    return value.number(is_tolerance ? Range::positive() : range);
  });
}

}  // namespace gonio
