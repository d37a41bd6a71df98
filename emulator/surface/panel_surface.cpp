#include "emulator/surface/panel_surface.hpp"

#include "emulator/surface/models.hpp"

namespace gonio {

Surface PanelSurface::mixed(const std::vector<SpotShare>& shares) const {
  std::vector<Surface> surfaces;
  std::vector<double> weights;
  for (const SpotShare& share : shares) {
    surfaces.push_back(coatings.at(share.region).surface(deviation + share.deviation));
    weights.push_back(share.weight);
  }
  return surfaces.size() == 1 ? surfaces.front() : mixture(surfaces, weights);
}

}  // namespace gonio
