#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emulator/core/input_error.hpp"
#include "emulator/core/yaml_map.hpp"

namespace gonio {

/// How surely a number of a standard is known.
struct Evidence {
  /// From the surest: `C2` two or more independent sources agree, `C1+calc` one source and a
  /// computation agree, `C1` one source, `calc` computed, `memory` and `memory-low` recalled.
  std::string level = "C2";
  std::vector<std::string> sources = {};  ///< keys of standards/sources.yaml

  /// Known only from memory: no verdict may rest on it.
  [[nodiscard]] bool is_informative() const;
  /// The less sure of two.
  [[nodiscard]] static const Evidence& weaker(const Evidence& a, const Evidence& b);
};

/// A number of a standard, where it stands, and how surely it is known.
template <class T>
struct Stated {
  T nominal;
  std::optional<T> tolerance = {};  ///< plus and minus; nothing if not known
  Evidence evidence = {};
  SourceMark mark = {};
};

/// Reads `{level: C1, sources: [W523]}`.
/// @throws InputError  for anything that is not as the schema says.
[[nodiscard]] Evidence read_evidence(const YamlNode& node);

/// Reads `{nominal: ..., tolerance: ..., evidence: {...}}`.
/// @param read  called with a node, and whether it is that of the tolerance; gives the number.
template <class T, class Read>
Stated<T> read_stated(const YamlNode& node, Read read) {
  return node.read_map([&](YamlMap& map) {
    Stated<T> stated{.nominal = read(map.required("nominal"), false)};
    if (const auto tolerance = map.optional("tolerance")) {
      stated.tolerance = read(*tolerance, true);
    }
    stated.evidence = read_evidence(map.required("evidence"));
    stated.mark = node.mark();
    return stated;
  });
}

/// The same of a dimensionless number. @param range  of the nominal value.
[[nodiscard]] Stated<double> read_stated_number(const YamlNode& node,
                                                const Range& range = Range::positive());

}  // namespace gonio
