#include "emulator/core/yaml_map.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <numbers>
#include <sstream>

#include "emulator/core/text_file.hpp"
#include "emulator/core/unicode.hpp"

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

namespace {

constexpr std::size_t deepest_nesting = 64;
constexpr std::size_t most_nodes = 1'000'000;
constexpr std::size_t longest_id = 64;
constexpr std::string_view text_only = "UTF-8 text without control characters";

/// Refuses a file with bytes that are no text, at the first of them.
void expect_text(const std::string& bytes, const std::string& file) {
  const auto bad = find_bad_text(bytes);
  if (!bad) {
    return;
  }
  const auto before = std::string_view(bytes).substr(0, bad->position);
  const auto line_begin = before.rfind('\n') + 1;  // npos + 1 is 0
  throw InputError({.file = file,
                    .line = int(std::count(before.begin(), before.end(), '\n')) + 1,
                    .column = int(before.size() - line_begin) + 1,
                    .key = {}},
                   std::string(text_only), bad->what);
}

/// Builds the tree from the parser's events, and refuses what the dialect leaves out.
class TreeBuilder : public YAML::EventHandler {
 public:
  explicit TreeBuilder(std::string file) : file_(std::move(file)) {}

  [[nodiscard]] std::unique_ptr<YamlTree> take_root() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (root_) {
      throw InputError(place(mark), "one document in the file", "a second document");
    }
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    refuse_anchor(mark, anchor);
    YamlTree* node = scalar(mark, "");
    if (node != nullptr && !node->key.empty()) {
      node->mark = node->key_mark;  // a missing value has the mark of what follows, lines below
    }
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    throw InputError(place(mark), "a value", "an alias");
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    refuse_anchor(mark, anchor);
    refuse_tag(mark, tag);
    scalar(mark, value);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(mark, tag, anchor, YamlKind::list);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(mark, tag, anchor, YamlKind::map);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Open {
    YamlTree* node;
    bool has_key = false;
    std::string key;
    SourceMark key_mark;
    std::set<std::string> keys;
  };

  [[nodiscard]] SourceMark place(const YAML::Mark& mark, const std::string& key = {}) const {
    return {.file = file_, .line = mark.line + 1, .column = mark.column + 1, .key = key};
  }

  void refuse_anchor(const YAML::Mark& mark, YAML::anchor_t anchor) const {
    if (anchor != 0) {
      throw InputError(place(mark), "a value without an anchor", "an anchor");
    }
  }
  void refuse_tag(const YAML::Mark& mark, const std::string& tag) const {
    if (!tag.empty() && tag != "?" && tag != "!") {
      throw InputError(place(mark), "a value without a tag", tag);
    }
  }

  /// A key, or a value. @return  the node of the value.
  YamlTree* scalar(const YAML::Mark& mark, const std::string& text) {
    if (const auto bad = find_bad_text(text)) {  // written as an escape, "\x1b"
      throw InputError(place(mark), std::string(text_only), bad->what);
    }
    if (!open_.empty() && open_.back().node->kind == YamlKind::map && !open_.back().has_key) {
      set_key(mark, text);
      return nullptr;
    }
    YamlTree* node = add(mark, YamlKind::scalar);
    node->text = text;
    return node;
  }

  void set_key(const YAML::Mark& mark, const std::string& key) {
    Open& map = open_.back();
    const SourceMark key_mark = place(mark, path_below(*map.node, key));
    if (!map.keys.insert(key).second) {
      throw InputError(key_mark, "each key once", "the key '" + key + "' a second time");
    }
    map.has_key = true;
    map.key = key;
    map.key_mark = key_mark;
  }

  void open(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, YamlKind kind) {
    refuse_anchor(mark, anchor);
    refuse_tag(mark, tag);
    if (!open_.empty() && open_.back().node->kind == YamlKind::map && !open_.back().has_key) {
      throw InputError(place(mark), "a key that is text", "a list or a map");
    }
    if (open_.size() >= deepest_nesting) {
      throw InputError(place(mark), fmt::format("nesting of at most {} levels", deepest_nesting),
                       "more");
    }
    YamlTree* node = add(mark, kind);
    open_.push_back({.node = node, .has_key = false, .key = {}, .key_mark = {}, .keys = {}});
  }

  void close() { open_.pop_back(); }

  YamlTree* add(const YAML::Mark& mark, YamlKind kind) {
    if (++count_ > most_nodes) {
      throw InputError(place(mark), fmt::format("at most {} values", most_nodes), "more");
    }
    auto node = std::make_unique<YamlTree>();
    node->kind = kind;
    node->mark = place(mark);
    YamlTree* result = node.get();
    if (open_.empty()) {
      root_ = std::move(node);
      return result;
    }
    Open& parent = open_.back();
    if (parent.node->kind == YamlKind::map) {
      node->key = parent.key;
      node->key_mark = parent.key_mark;
      node->mark.key = parent.key_mark.key;
      parent.has_key = false;
    } else {
      node->mark.key = fmt::format("{}[{}]", parent.node->mark.key, parent.node->children.size());
    }
    parent.node->children.push_back(std::move(node));
    return result;
  }

  static std::string path_below(const YamlTree& map, const std::string& key) {
    return map.mark.key.empty() ? key : map.mark.key + "." + key;
  }

  std::string file_;
  std::unique_ptr<YamlTree> root_;
  std::vector<Open> open_;
  std::size_t count_ = 0;
};

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
  expect_text(text, name);
  TreeBuilder builder(name);
  // yaml-cpp 0.7 takes a quotation that nobody closed for complete if the text ends with a line
  // break. After a last comment it does not.
  std::istringstream in(text.ends_with('\n') ? text + "#" : text);
  try {
    YAML::Parser parser(in);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    const bool placed = !error.mark.is_null();
    throw InputError({.file = name,
                      .line = placed ? error.mark.line + 1 : 1,
                      .column = placed ? error.mark.column + 1 : 1,
                      .key = {}},
                     "YAML", error.msg);
  }
  std::shared_ptr<const YamlTree> root = builder.take_root();
  if (!root) {
    throw InputError({.file = name, .line = 1, .column = 1, .key = {}}, "YAML with content",
                     "nothing");
  }
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
