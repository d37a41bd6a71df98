#include "emulator/standard/flop_rule.hpp"

namespace gonio {

Evidence FlopRule::evidence() const {
  return Evidence::weaker(Evidence::weaker(factor.evidence, power.evidence), face_power.evidence);
}

FlopRule read_flop_rule(const YamlNode& node) {
  return node.read_map([](YamlMap& map) {
    return FlopRule{.near_specular = map.required("near").text(),
                    .face = map.required("face").text(),
                    .far = map.required("far").text(),
                    .factor = read_stated_number(map.required("factor")),
                    .power = read_stated_number(map.required("power")),
                    .face_power = read_stated_number(map.required("face_power"))};
  });
}

}  // namespace gonio
