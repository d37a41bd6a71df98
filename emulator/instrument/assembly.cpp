#include "emulator/instrument/assembly.hpp"

#include <utility>

#include "emulator/surface/models.hpp"

namespace gonio {

namespace {

/// The reference glass reads the value of the scale by definition; what an integrator makes of the
/// quotient of two equal fluxes may differ in the last digit.
double tile_optics_gu(const Glossmeter& glossmeter, const std::string& geometry_id,
                      double tile_index, double tolerance) {
  const Scale& scale = glossmeter.instrument().standard.scale;
  if (scale.refractive_index && tile_index == scale.refractive_index->nominal) {
    return scale.value.nominal;
  }
  const WavelengthGrid& grid = glossmeter.grid();
  const Surface tile = smooth(grid, Eigen::ArrayXcd::Constant(grid.size(), tile_index));
  return glossmeter.read(tile, geometry_id, tolerance).gloss;
}

StatedSetup stated_setup(const Instrument& instrument, const std::string& geometry_id) {
  StatedSetup setup;
  for (std::size_t i = 0; i < setup.size(); ++i) {
    setup.at(i) = as_built(instrument, geometry_id, static_cast<SetupQuantity>(i));
  }
  return setup;
}

/// What one geometry sees of a sample: of a panel, what its spot covers in the middle.
Surface surface_seen(const Sample& sample, const Instrument& instrument,
                     const std::string& geometry_id) {
  if (!sample.panel) {
    return sample.surface;
  }
  const PanelLayout& panel = *sample.panel->layout;
  const Spot spot = instrument.spot(geometry_id, 0.5 * panel.length_mm, 0.5 * panel.width_mm);
  return sample.panel->mixed(shares(panel, spot));
}

}  // namespace

Device assemble_device(const Glossmeter& glossmeter, Behaviour behaviour,
                       const std::vector<Sample>& samples, double tolerance) {
  const Instrument& instrument = glossmeter.instrument();
  std::vector<Channel> channels;
  for (const std::string& id : instrument.geometries) {
    const Angle theta_i = instrument.standard.geometry(id).theta_i.nominal;
    channels.push_back(
        {.geometry_id = id,
         .theta_i = theta_i,
         .tile_assigned_gu =
             assigned_gloss(behaviour.tile_index, theta_i, instrument.standard.scale),
         .tile_optics_gu = tile_optics_gu(glossmeter, id, behaviour.tile_index, tolerance),
         .setup = stated_setup(instrument, id)});
  }
  std::vector<DeviceSample> laid_out;
  for (const Sample& sample : samples) {
    DeviceSample laid{.id = sample.id, .title = sample.title, .gloss_gu = {}};
    for (const Channel& channel : channels) {
      laid.gloss_gu.push_back(glossmeter
                                  .read(surface_seen(sample, instrument, channel.geometry_id),
                                        channel.geometry_id, tolerance, sample.tilt)
                                  .gloss);
    }
    laid_out.push_back(std::move(laid));
  }
  return {instrument.identity, std::move(behaviour), std::move(channels), std::move(laid_out)};
}

}  // namespace gonio
