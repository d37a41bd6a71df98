#pragma once

#include <memory>
#include <string>
#include <vector>

#include "emulator/core/input_error.hpp"

// What YamlNode stands on: the tree of a file in the strict dialect.

namespace gonio {

enum class YamlKind { scalar, list, map };

/// A node of a loaded file, with its children.
struct YamlTree {
  YamlKind kind = YamlKind::scalar;
  std::string text;                                 // of a scalar
  SourceMark mark;                                  // of the value
  std::string key;                                  // in the map above; empty in a list
  SourceMark key_mark;                              // of that key
  std::vector<std::unique_ptr<YamlTree>> children;  // of a list or a map, in the file's order
};

/// Builds the tree of a text. @param name  stands for the file in messages.
/// @throws InputError  for a text that is not YAML of the dialect, see YamlNode, or is empty.
[[nodiscard]] std::shared_ptr<const YamlTree> parse_yaml(const std::string& text,
                                                         const std::string& name);

}  // namespace gonio
