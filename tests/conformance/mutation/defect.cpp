#include "tests/conformance/mutation/defect.hpp"

#include <algorithm>

#include "emulator/instrument/overlay.hpp"

namespace gonio::conformance {

namespace {

std::vector<std::string> read_texts(const YamlNode& node) {
  std::vector<std::string> texts;
  for (const YamlNode& item : node.list()) {
    texts.push_back(item.text());
  }
  return texts;
}

std::vector<std::string> read_standards(const YamlNode& node, const Catalog& catalog) {
  for (const YamlNode& item : node.list()) {
    (void)catalog.find(Catalog::Kind::standard, item);
  }
  return read_texts(node);
}

/// One of those that are known by name.
template <class Function>
Function read_named(const YamlNode& node, const std::map<std::string, Function>& known) {
  std::vector<std::string> names;
  for (const auto& [name, function] : known) {
    names.push_back(name);
  }
  return known.at(node.choice(names));
}

Standard standard_of(const std::string& id, const Catalog& catalog) {
  return load_standard(catalog.find(Catalog::Kind::standard, id), catalog);
}

/// Reads what is wrong. Overlays are tried here, so that an error in them is found at once.
void read_change(YamlMap& map, const Defects& all, const Catalog& catalog, Defect& defect) {
  const auto read_overlay_of = [&](const char* key) {
    const auto node = map.optional(key);
    if (node) {
      const Standard standard = standard_of(defect.standards.front(), catalog);
      (void)with_overlay(all.healthy_instrument(standard, catalog), *node, catalog);
    }
    return node;
  };
  defect.set = read_overlay_of("set");
  defect.unstated = read_overlay_of("unstated");
  if (const auto index = map.optional("certificate_index")) {
    defect.certificate_index = index->number({.low = 1.0, .high = 5.0, .low_open = true});
  }
  if (const auto name = map.optional("optics")) {
    defect.optics = read_named(*name, optics_defects());
  }
  if (const auto name = map.optional("device")) {
    defect.device = read_named(*name, port_defects());
  }
  if (const auto rules = map.optional("standard")) {
    defect.standard = read_standard_defect(*rules);
  }
}

bool is_sound(const Defect& defect) {
  return !defect.set && !defect.unstated && !defect.certificate_index && defect.optics == nullptr &&
         defect.device == nullptr && !defect.standard;
}

Defect read_defect(const YamlNode& node, const Defects& all, const Catalog& catalog) {
  return node.read_map([&](YamlMap& map) {
    const YamlNode id = map.required("id");
    Defect defect{.id = id.id(),
                  .wrong = map.required("wrong").line(),
                  .mark = node.mark(),
                  .standards = all.standards,
                  .clauses = read_texts(map.required("clauses"))};
    if (std::any_of(all.defects.begin(), all.defects.end(),
                    [&](const Defect& other) { return other.id == defect.id; })) {
      id.fail("each defect once");
    }
    if (const auto standards = map.optional("standards")) {
      defect.standards = read_standards(*standards, catalog);
    }
    read_change(map, all, catalog, defect);
    if (is_sound(defect)) {
      node.fail("one of set, unstated, certificate_index, optics, device, standard", "none");
    }
    return defect;
  });
}

}  // namespace

Instrument Defects::healthy_instrument(const Standard& standard, const Catalog& catalog) const {
  Instrument nominal = nominal_instrument(standard);
  return healthy ? with_overlay(std::move(nominal), *healthy, catalog) : nominal;
}

Defects load_defects(const std::filesystem::path& file, const Catalog& catalog) {
  return YamlNode::load(file).read_map([&](YamlMap& map) {
    map.expect_schema("gonio/defects/1");
    Defects all{.standards = read_standards(map.required("standards"), catalog), .defects = {}};
    all.healthy = map.optional("healthy");
    (void)all.healthy_instrument(standard_of(all.standards.front(), catalog), catalog);
    for (const YamlNode& node : map.required("defects").list()) {
      all.defects.push_back(read_defect(node, all, catalog));
    }
    return all;
  });
}

}  // namespace gonio::conformance
