#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/core/angle.hpp"
#include "emulator/core/input_error.hpp"
#include "emulator/core/length.hpp"
#include "emulator/core/quantity.hpp"

namespace gonio {

class YamlMap;
struct YamlTree;

/// A value in a YAML file that knows where it stands. Every reader throws InputError with that
/// place when the value is not what was asked for. Cheap to copy; keeps its file's tree alive.
///
/// The dialect is strict: a doubled key, an anchor or alias, a tag, nesting deeper than 64 or more
/// than a million nodes, a second document, bytes that are not UTF-8, and control characters other
/// than tab and line break are errors when the file is loaded.
class YamlNode {
 public:
  /// @throws InputError  for a file that is missing, empty, or not YAML of this dialect.
  [[nodiscard]] static YamlNode load(const std::filesystem::path& path);
  /// The same from text; `name` stands for the file in messages.
  [[nodiscard]] static YamlNode parse(const std::string& text, const std::string& name);

  [[nodiscard]] bool is_scalar() const;
  [[nodiscard]] bool is_list() const;
  [[nodiscard]] bool is_map() const;

  [[nodiscard]] std::string text() const;  ///< a scalar as it is written, not empty
  [[nodiscard]] std::string line() const;  ///< text without tabs and line breaks, e.g. a title
  [[nodiscard]] std::string id() const;    ///< 1 to 64 letters, digits, '_', '-' and '.'
  [[nodiscard]] double number(const Range& range = Range::any()) const;
  [[nodiscard]] int integer(int low, int high) const;
  [[nodiscard]] bool boolean() const;  ///< true or false, nothing else
  [[nodiscard]] Angle angle(const Range& range_deg = Range::any()) const;
  [[nodiscard]] Length length(const Range& range_nm = Range::any()) const;
  [[nodiscard]] double gloss_gu(const Range& range_gu = Range::any()) const;
  [[nodiscard]] double time_s(const Range& range_s = Range::any()) const;
  [[nodiscard]] double temperature_c(const Range& range_c = Range::any()) const;
  [[nodiscard]] double temperature_difference_k(const Range& range_k = Range::any()) const;
  /// The value, which must be one of `choices`.
  [[nodiscard]] std::string choice(const std::vector<std::string>& choices) const;
  /// A file path, resolved relative to the folder of this YAML file.
  [[nodiscard]] std::filesystem::path file_path() const;
  [[nodiscard]] std::filesystem::path file() const;  ///< the same, of a file that is there
  [[nodiscard]] std::vector<YamlNode> list() const;  ///< a list of at least one item
  [[nodiscard]] std::vector<YamlNode> list_or_empty() const;

  /// Calls `read` with this map and returns what it returns.
  /// A key of the map that `read` did not ask for is an error at its line.
  template <class Read>
  auto read_map(Read&& read) const;
  /// Calls `read(id, value)` for each entry of a map whose keys are names, in the file's order.
  void for_each_entry(const std::function<void(const std::string&, const YamlNode&)>& read) const;

  [[nodiscard]] const SourceMark& mark() const;
  /// Throws InputError at this node, with the node's own text as what was found.
  [[noreturn]] void fail(const std::string& expected) const;
  [[noreturn]] void fail(const std::string& expected, const std::string& found) const;

 private:
  friend class YamlMap;
  friend struct YamlTree;
  explicit YamlNode(std::shared_ptr<const YamlTree> tree, const YamlTree* node);
  [[nodiscard]] double quantity(Dimension dimension, const Range& range, double shown_unit) const;
  [[nodiscard]] const YamlTree& as_map() const;
  [[nodiscard]] YamlNode child(const YamlTree& node) const { return YamlNode(root_, &node); }

  std::shared_ptr<const YamlTree> root_;
  const YamlTree* node_;
};

/// A map being read: keeps account of the keys that were asked for.
class YamlMap {
 public:
  explicit YamlMap(const YamlNode& node);

  /// @throws InputError  at the map if the key is missing.
  [[nodiscard]] YamlNode required(const std::string& key);
  [[nodiscard]] std::optional<YamlNode> optional(const std::string& key);
  [[nodiscard]] bool has(const std::string& key) { return optional(key).has_value(); }
  /// Accepts all keys that were not asked for: for files of others that we read in part.
  void ignore_others() { ignore_others_ = true; }
  /// The first key must be `schema` with this value, e.g. "gonio/sample/1".
  void expect_schema(const std::string& schema);
  /// @throws InputError  at the first key that nobody asked for.
  void expect_no_others() const;

  [[nodiscard]] const YamlNode& node() const { return node_; }

 private:
  YamlNode node_;
  std::set<std::string> asked_;
  bool ignore_others_ = false;
};

template <class Read>
auto YamlNode::read_map(Read&& read) const {
  YamlMap map(*this);
  auto result = read(map);
  map.expect_no_others();
  return result;
}

}  // namespace gonio
