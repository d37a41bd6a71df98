#include "emulator/standard/setup_quantity.hpp"

#include <algorithm>

namespace gonio {

std::optional<SetupQuantity> setup_quantity(const std::string& name) {
  const auto found = std::find(setup_quantity_names.begin(), setup_quantity_names.end(), name);
  if (found == setup_quantity_names.end()) {
    return std::nullopt;
  }
  return SetupQuantity(found - setup_quantity_names.begin());
}

const ApertureSize* aperture_size(const GeometryLimits& limits, SetupQuantity quantity) {
  const auto size = [](const std::optional<ApertureSize>& stated) {
    return stated ? &*stated : nullptr;
  };
  switch (quantity) {
    case SetupQuantity::theta_i:
    case SetupQuantity::theta_r:
      return nullptr;
    case SetupQuantity::source_in_plane:
      return size(limits.source.in_plane);
    case SetupQuantity::source_perpendicular:
      return size(limits.source.perpendicular);
    case SetupQuantity::source_diameter:
      return size(limits.source.diameter);
    case SetupQuantity::receptor_in_plane:
      return size(limits.receptor.in_plane);
    case SetupQuantity::receptor_perpendicular:
      return size(limits.receptor.perpendicular);
    case SetupQuantity::receptor_diameter:
      return size(limits.receptor.diameter);
  }
  return nullptr;
}

const Stated<Angle>* limit_of(const GeometryLimits& limits, SetupQuantity quantity) {
  switch (quantity) {
    case SetupQuantity::theta_i:
      return &limits.theta_i;
    case SetupQuantity::theta_r:
      return limits.theta_r ? &*limits.theta_r : nullptr;
    default: {
      const ApertureSize* size = aperture_size(limits, quantity);
      return size != nullptr && size->value ? &*size->value : nullptr;
    }
  }
}

}  // namespace gonio
