#include "emulator/core/yaml_tree.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "emulator/core/unicode.hpp"

namespace gonio {

namespace {

constexpr std::size_t deepest_nesting = 64;
constexpr std::size_t most_nodes = 1'000'000;
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

}  // namespace

std::shared_ptr<const YamlTree> parse_yaml(const std::string& text, const std::string& name) {
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
  return root;
}

}  // namespace gonio
