#include "emulator/standard/profile_rule.hpp"

#include <cmath>

#include "emulator/standard/standard.hpp"

namespace gonio {

namespace {

/// Reads the rules of one file, whose geometries are looked up beside it.
class RuleReader {
 public:
  RuleReader(std::filesystem::path file, const Catalog& catalog)
      : file_(std::move(file)), catalog_(catalog) {}

  ProfileRule read(const YamlNode& node, const std::string& standard,
                   const std::vector<ProfileRule>& before) {
    return node.read_map([&](YamlMap& map) {
      ProfileRule rule{.standard = standard,
                       .id = map.required("id").id(),
                       .title = map.required("title").line(),
                       .factor = {},
                       .divisor = {}};
      for (const ProfileRule& other : before) {
        if (other.id == rule.id) {
          map.required("id").fail("each rule once");
        }
      }
      if (const auto haze = map.optional("haze")) {
        read_haze(*haze, rule);
      } else if (const auto logarithmic = map.optional("logarithmic")) {
        read_logarithmic(*logarithmic, before, rule);
      } else if (const auto doi = map.optional("doi")) {
        read_doi(*doi, rule);
      } else {
        read_clarity(map.required("clarity"), rule);
      }
      return rule;
    });
  }

 private:
  const GeometryLimits& geometry(const YamlNode& node) {
    if (!standard_) {
      standard_ = load_standard(file_.parent_path() / "standard.yaml", catalog_);
    }
    for (const GeometryLimits& limits : standard_->geometries) {
      if (limits.id == node.text()) {
        return limits;
      }
    }
    node.fail("a geometry of " + standard_->id);
  }

  void add_fields(const YamlNode& at, const YamlNode& fields, ProfileRule& rule) {
    const Angle mirror = geometry(at).receptor_angle();
    rule.theta_i = geometry(at).theta_i.nominal;
    for (const YamlNode& item : fields.list()) {
      const GeometryLimits& limits = geometry(item);
      ProfileField field{.offset = limits.receptor_angle() - mirror, .evidence = limits.evidence()};
      if (limits.receptor.in_plane && limits.receptor.in_plane->value) {
        field.width = limits.receptor.in_plane->value->nominal;
      }
      rule.evidence = Evidence::weaker(rule.evidence, field.evidence);
      rule.fields.push_back(field);
    }
  }

  void read_haze(const YamlNode& node, ProfileRule& rule) {
    rule.kind = ProfileRule::Kind::haze;
    rule.is_mean = node.read_map([&](YamlMap& map) {
      rule.evidence = read_evidence(map.required("evidence"));
      add_fields(map.required("at"), map.required("fields"), rule);
      return map.required("combine").choice({"mean", "sum"}) == "mean";
    });
  }

  static void read_logarithmic(const YamlNode& node, const std::vector<ProfileRule>& before,
                               ProfileRule& rule) {
    rule.kind = ProfileRule::Kind::logarithmic;
    rule.of = node.read_map([&](YamlMap& map) {
      rule.factor = read_stated_number(map.required("factor"));
      rule.divisor = read_stated_number(map.required("divisor"));
      rule.evidence = Evidence::weaker(rule.factor->evidence, rule.divisor->evidence);
      const YamlNode of = map.required("of");
      for (const ProfileRule& other : before) {
        if (other.id == of.text() && other.kind == ProfileRule::Kind::haze) {
          rule.theta_i = other.theta_i;
          rule.evidence = Evidence::weaker(rule.evidence, other.evidence);
          return other.id;
        }
      }
      of.fail("a haze that stands before it");
    });
  }

  void read_doi(const YamlNode& node, ProfileRule& rule) {
    rule.kind = ProfileRule::Kind::doi;
    rule.is_mean = node.read_map([&](YamlMap& map) {
      rule.evidence = read_evidence(map.required("evidence"));
      if (const auto at = map.optional("at")) {
        add_fields(*at, map.required("beside"), rule);
        return true;
      }
      const auto offset =
          read_stated<Angle>(map.required("offset"), [](const YamlNode& value, bool) {
            return value.angle({.low = 0.0, .high = 90.0, .low_open = true});
          });
      rule.fields = {{.offset = -offset.nominal, .evidence = offset.evidence},
                     {.offset = offset.nominal, .evidence = offset.evidence}};
      rule.evidence = Evidence::weaker(rule.evidence, offset.evidence);
      return true;
    });
  }

  static void read_clarity(const YamlNode& node, ProfileRule& rule) {
    constexpr double per_nanometre = 1e-6;
    rule.kind = ProfileRule::Kind::clarity;
    rule.evidence = node.read_map([&](YamlMap& map) {
      for (const YamlNode& width : map.required("combs").list()) {
        rule.comb_mm.push_back(width.length(Range::positive()).nanometres() * per_nanometre);
      }
      return read_evidence(map.required("evidence"));
    });
  }

  std::filesystem::path file_;
  const Catalog& catalog_;
  std::optional<Standard> standard_ = {};
};

}  // namespace

ProfileRules load_profile_rules(const std::filesystem::path& path, const Catalog& catalog) {
  return YamlNode::load(path).read_map([&](YamlMap& map) {
    map.expect_schema("gonio/profile_rules/1");
    ProfileRules rules{.id = map.required("id").line(),
                       .title = map.required("title").line(),
                       .notes = map.required("notes").text()};
    RuleReader reader(path, catalog);
    for (const YamlNode& item : map.required("rules").list()) {
      rules.rules.push_back(reader.read(item, rules.id, rules.rules));
    }
    return rules;
  });
}

double logarithmic_haze(const ProfileRule& rule, double haze) {
  return rule.factor->nominal * std::log10(haze / rule.divisor->nominal + 1.0);
}

}  // namespace gonio
