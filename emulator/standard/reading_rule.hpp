#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emulator/core/yaml_map.hpp"
#include "emulator/standard/evidence.hpp"

namespace gonio {

/// How often a specimen is read, what the spread of its readings means, and what is reported.
/// The range is that between the extremes; a share is one of the mean.
struct ReadingRule {
  struct Count {
    int at_least = 1;
    Evidence evidence = {};
    SourceMark mark = {};
  };
  /// Further readings where the range is larger than that.
  struct More {
    double when_range_above_gu = 0.0;
    std::optional<int> count = {};  ///< how many; nothing: the standard does not say
    Evidence evidence = {};
    SourceMark mark = {};
  };
  /// A remark in the report where a reading differs from the mean by more than that share.
  struct NotUniform {
    double when_share_above = 0.0;
    Evidence evidence = {};
    SourceMark mark = {};
  };
  /// The specimen is not to be used where the range reaches one of these.
  struct Reject {
    std::optional<double> range_at_least_gu = {}, share_at_least = {};
    Evidence evidence = {};
    SourceMark mark = {};
  };
  struct Report {
    std::vector<std::string> values = {};  ///< mean, range
    Evidence evidence = {};
    SourceMark mark = {};
  };

  Count count;
  std::optional<More> more = {};
  std::optional<NotUniform> not_uniform = {};
  std::optional<Reject> reject = {};
  std::optional<Report> report = {};
};

/// Reads the map `readings` of a standard.
/// @throws InputError  for anything that is not as the schema says.
[[nodiscard]] ReadingRule read_reading_rule(const YamlNode& node);

}  // namespace gonio
