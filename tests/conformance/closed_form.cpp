#include "tests/conformance/closed_form.hpp"

#include <cmath>

namespace gonio::conformance {

namespace {

double reflectance(std::complex<double> index, double theta) {
  const double sine = std::sin(theta);
  const double cosine = std::cos(theta);
  const double product = sine * std::tan(theta);
  const std::complex<double> q = std::sqrt(index * index - sine * sine);
  const double perpendicular = std::norm((cosine - q) / (cosine + q));
  const double parallel = perpendicular * std::norm((q - product) / (q + product));
  return 0.5 * (perpendicular + parallel);
}

}  // namespace

PolishedArtefact read_polished_artefact(const YamlNode& node) {
  return node.read_map([](YamlMap& map) {
    PolishedArtefact artefact;
    if (const auto reflectance = map.optional("reflectance")) {
      artefact.reflectance = reflectance->number(Range::closed(0.0, 1.0));
      return artefact;
    }
    const double n = map.required("n").number(Range::positive());
    const auto k = map.optional("k");
    artefact.index = {n, k ? k->number(Range::not_negative()) : 0.0};
    return artefact;
  });
}

double closed_form_gloss(const PolishedArtefact& artefact, Angle theta_i, const Scale& scale) {
  const double theta = theta_i.radians();
  const double found =
      artefact.reflectance ? *artefact.reflectance : reflectance(artefact.index, theta);
  const double reference =
      scale.refractive_index ? reflectance(scale.refractive_index->nominal, theta) : 1.0;
  return scale.value.nominal * found / reference;
}

}  // namespace gonio::conformance
