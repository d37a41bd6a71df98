#include "emulator/core/yaml_map.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numbers>

#include "emulator/core/text_file.hpp"
#include "emulator/core/yaml_tree.hpp"

namespace gonio {

namespace {

constexpr std::size_t longest_id = 64;

std::string found_in(const YamlTree& node) {
  switch (node.kind) {
    case YamlKind::scalar:
      return node.text.empty() ? "nothing" : node.text;
    case YamlKind::list:
      return "a list";
    case YamlKind::map:
      return "a map";
  }
  return "nothing";
}

std::string key_list(const YamlTree& map) {
  std::vector<std::string> keys;
  for (const auto& child : map.children) {
    keys.push_back(child->key);
  }
  return fmt::format("{}", fmt::join(keys, ", "));
}

}  // namespace

YamlNode::YamlNode(std::shared_ptr<const YamlTree> tree, const YamlTree* node)
    : root_(std::move(tree)), node_(node) {}

YamlNode YamlNode::load(const std::filesystem::path& path) {
  return parse(read_text_file(path), path.string());
}

YamlNode YamlNode::parse(const std::string& text, const std::string& name) {
  const std::shared_ptr<const YamlTree> root = parse_yaml(text, name);
  return YamlNode(root, root.get());
}

bool YamlNode::is_scalar() const { return node_->kind == YamlKind::scalar; }
bool YamlNode::is_list() const { return node_->kind == YamlKind::list; }
bool YamlNode::is_map() const { return node_->kind == YamlKind::map; }
const SourceMark& YamlNode::mark() const { return node_->mark; }

void YamlNode::fail(const std::string& expected) const { fail(expected, found_in(*node_)); }
void YamlNode::fail(const std::string& expected, const std::string& found) const {
  throw InputError(mark(), expected, found);
}

std::string YamlNode::text() const {
  if (!is_scalar() || node_->text.empty()) {
    fail("text");
  }
  return node_->text;
}

std::string YamlNode::line() const {
  std::string result = text();
  if (result.find_first_of("\t\r\n") != std::string::npos) {
    fail("text in one line, without tabs");
  }
  return result;
}

std::string YamlNode::id() const {
  constexpr std::string_view allowed =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  if (!is_scalar() || node_->text.empty() || node_->text.size() > longest_id ||
      node_->text.find_first_not_of(allowed) != std::string::npos) {
    fail("an id of letters, digits, '_', '-' and '.'");
  }
  return node_->text;
}

double YamlNode::quantity(Dimension dimension, const Range& range, double shown_unit) const {
  const auto value = is_scalar() ? parse_quantity(node_->text, dimension) : std::nullopt;
  const double shown = value.value_or(0.0) / shown_unit;
  if (!value || !range.contains(shown)) {
    fail(expected_quantity(dimension) + range.text());
  }
  return *value;
}

double YamlNode::number(const Range& range) const {
  return quantity(Dimension::number, range, 1.0);
}
Angle YamlNode::angle(const Range& range_deg) const {
  return radians(quantity(Dimension::angle, range_deg, std::numbers::pi / 180.0));
}
Length YamlNode::length(const Range& range_nm) const {
  return nanometres(quantity(Dimension::length, range_nm, 1.0));
}
double YamlNode::gloss_gu(const Range& range_gu) const {
  return quantity(Dimension::gloss, range_gu, 1.0);
}
double YamlNode::time_s(const Range& range_s) const {
  return quantity(Dimension::time, range_s, 1.0);
}
double YamlNode::temperature_c(const Range& range_c) const {
  return quantity(Dimension::temperature, range_c, 1.0);
}
double YamlNode::temperature_difference_k(const Range& range_k) const {
  return quantity(Dimension::temperature_difference, range_k, 1.0);
}

int YamlNode::integer(int low, int high) const {
  const auto value = is_scalar() ? parse_quantity(node_->text, Dimension::number) : std::nullopt;
  if (!value || *value < low || *value > high || *value != static_cast<int>(*value)) {
    fail(fmt::format("a whole number in [{}, {}]", low, high));
  }
  return static_cast<int>(*value);
}

bool YamlNode::boolean() const { return choice({"true", "false"}) == "true"; }

std::string YamlNode::choice(const std::vector<std::string>& choices) const {
  for (const std::string& known : choices) {
    if (is_scalar() && node_->text == known) {
      return known;
    }
  }
  fail(fmt::format("one of {}", fmt::join(choices, ", ")));
}

std::filesystem::path YamlNode::file_path() const {
  const std::filesystem::path folder = std::filesystem::path(mark().file).parent_path();
  return (folder / text()).lexically_normal();
}

std::filesystem::path YamlNode::file() const {
  std::filesystem::path path = file_path();
  if (const std::string there = what_stands_at(path); there != "a file") {
    fail("a file", there == "nothing" ? text() : there);
  }
  return path;
}

std::vector<YamlNode> YamlNode::list() const {
  if (!is_list() || node_->children.empty()) {
    fail("a list of at least one item");
  }
  return list_or_empty();
}

std::vector<YamlNode> YamlNode::list_or_empty() const {
  if (!is_list()) {
    fail("a list");
  }
  std::vector<YamlNode> items;
  for (const auto& item : node_->children) {
    items.push_back(child(*item));
  }
  return items;
}

const YamlTree& YamlNode::as_map() const {
  if (!is_map()) {
    fail("a map of keys and values");
  }
  return *node_;
}

void YamlNode::for_each_entry(
    const std::function<void(const std::string&, const YamlNode&)>& read) const {
  for (const auto& entry : as_map().children) {
    read(entry->key, child(*entry));
  }
}

YamlMap::YamlMap(const YamlNode& node) : node_(node) { (void)node_.as_map(); }

std::optional<YamlNode> YamlMap::optional(const std::string& key) {
  asked_.insert(key);
  for (const auto& entry : node_.node_->children) {
    if (entry->key == key) {
      return node_.child(*entry);
    }
  }
  return std::nullopt;
}

YamlNode YamlMap::required(const std::string& key) {
  if (auto value = optional(key)) {
    return *value;
  }
  SourceMark mark = node_.mark();
  mark.key = mark.key.empty() ? key : mark.key + "." + key;
  throw InputError(mark, fmt::format("the key '{}'", key), "only " + key_list(*node_.node_));
}

void YamlMap::expect_schema(const std::string& schema) {
  const YamlNode value = required("schema");
  if (node_.node_->children.front()->key != "schema") {
    throw InputError(node_.node_->children.front()->key_mark, "the key 'schema' first",
                     node_.node_->children.front()->key);
  }
  if (value.text() != schema) {
    value.fail(schema);
  }
}

void YamlMap::expect_no_others() const {
  if (ignore_others_) {
    return;
  }
  for (const auto& entry : node_.node_->children) {
    if (!asked_.contains(entry->key)) {
      throw InputError(entry->key_mark, fmt::format("one of the keys {}", fmt::join(asked_, ", ")),
                       entry->key);
    }
  }
}

}  // namespace gonio
