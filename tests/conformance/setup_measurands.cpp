// What the device, or its maker, states of its set-up.
#include <cmath>

#include "emulator/instrument/setup.hpp"
#include "tests/conformance/measurands.hpp"

namespace gonio::conformance {

namespace {

std::optional<StatedAngle> stated_setup(const MeasurementContext& context, SetupQuantity quantity) {
  const auto channel = context.bench.channel(*context.clause.geometry);
  if (!channel) {
    throw NotOffered("the device has no such geometry");
  }
  return context.bench.port().setup(*channel, quantity);
}

StatedAngle needed_setup(const MeasurementContext& context, SetupQuantity quantity) {
  const auto stated = stated_setup(context, quantity);
  if (!stated) {
    throw NotOffered(std::string("the device does not state its ") +
                     setup_quantity_names[std::size_t(quantity)]);
  }
  return *stated;
}

std::string note_on(const StatedAngle& stated) {
  return stated.expanded_uncertainty.radians() > 0.0 ? "" : "stated without an uncertainty";
}

template <SetupQuantity quantity>
Measurement read_setup(YamlMap&, MeasurandContext&) {
  return [](const MeasurementContext& context) {
    const StatedAngle stated = needed_setup(context, quantity);
    return std::vector<Finding>{
        {.geometry = *context.clause.geometry,
         .unit = "deg",
         .value = stated_degrees(stated.value),
         .expanded_uncertainty = stated_degrees(stated.expanded_uncertainty),
         .note = note_on(stated)}};
  };
}

/// How far the image of the source lies from the centre of the receptor.
Measurement read_image_offset(YamlMap&, MeasurandContext&) {
  return [](const MeasurementContext& context) {
    const StatedAngle theta_i = needed_setup(context, SetupQuantity::theta_i);
    const StatedAngle theta_r = needed_setup(context, SetupQuantity::theta_r);
    return std::vector<Finding>{
        {.geometry = *context.clause.geometry,
         .unit = "deg",
         .value = stated_degrees(theta_r.value - theta_i.value),
         .expanded_uncertainty = std::hypot(theta_i.expanded_uncertainty.degrees(),
                                            theta_r.expanded_uncertainty.degrees()),
         .note = note_on(theta_i)}};
  };
}

}  // namespace

std::map<std::string, MeasurandReader> setup_measurands() {
  using enum SetupQuantity;
  return {{"theta_i", read_setup<theta_i>},
          {"theta_r", read_setup<theta_r>},
          {"source_in_plane", read_setup<source_in_plane>},
          {"source_perpendicular", read_setup<source_perpendicular>},
          {"source_diameter", read_setup<source_diameter>},
          {"receptor_in_plane", read_setup<receptor_in_plane>},
          {"receptor_perpendicular", read_setup<receptor_perpendicular>},
          {"receptor_diameter", read_setup<receptor_diameter>},
          {"image_offset", read_image_offset}};
}

}  // namespace gonio::conformance
