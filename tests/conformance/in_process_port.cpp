#include "tests/conformance/in_process_port.hpp"

#include <algorithm>

#include "emulator/instrument/assembly.hpp"
#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/surface/sample.hpp"

namespace gonio::conformance {

namespace {

constexpr double tolerance_gu = 1e-4;  // of the integrator: far below any limit of a standard
constexpr double step_s = 0.25;        // in which a running command is looked at
constexpr double longest_command_s = 3600.0;

}  // namespace

InProcessPort::InProcessPort(Instrument instrument, std::vector<std::string> samples,
                             Assemble assemble)
    : instrument_(std::move(instrument)),
      samples_(std::move(samples)),
      assemble_(std::move(assemble)) {
  const Standard& standard = instrument_.standard;
  for (std::size_t j = 0; j < instrument_.geometries.size(); ++j) {
    const std::string& id = instrument_.geometries[j];
    PortChannel channel{.geometry_id = id, .theta_i = standard.geometry(id).theta_i.nominal};
    if (!instrument_.behaviour.full_scale_gu.empty()) {
      channel.full_scale_gu = instrument_.behaviour.full_scale_gu.at(j);
    }
    channel.tile_assigned_gu =
        assigned_gloss(instrument_.behaviour.tile_index, channel.theta_i, standard.scale);
    channels_.push_back(channel);
  }
}

std::string InProcessPort::where() const {
  return instrument_.file.empty() ? instrument_.standard.file.string() : instrument_.file.string();
}

Device& InProcessPort::device() {
  if (!device_) {
    try {
      device_ = assemble_(instrument_, samples_);
    } catch (const InputError& error) {
      throw NotOffered(std::string("nothing can be read: ") + error.what());
    }
  }
  return *device_;
}

std::optional<StatedAngle> InProcessPort::setup(std::size_t channel, SetupQuantity quantity) {
  return as_built(instrument_, instrument_.geometries.at(channel), quantity);
}

void InProcessPort::place(PortCover cover, const std::string& sample) {
  int index = 0;
  if (cover == PortCover::sample) {
    const auto& known = device().samples();
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&](const DeviceSample& s) { return s.id == sample; });
    if (found == known.end()) {
      throw NotOffered("there is no sample " + sample);
    }
    index = int(found - known.begin());
  }
  device().place(cover, index);
}

DeviceError InProcessPort::command(DeviceCommand command) {
  if (!device().command(command)) {
    return DeviceError::busy;
  }
  for (double waited_s = 0.0; device().status().command.state == CommandState::running;
       waited_s += step_s) {
    if (waited_s > longest_command_s) {
      throw DeviceLost("a command did not end within an hour");
    }
    device().advance(step_s);
  }
  return device().status().command.error;
}

PortStatus InProcessPort::status() {
  const Device::Status& status = device().status();
  PortStatus result{.state = status.state, .is_calibration_due = status.is_calibration_due};
  for (const ChannelStatus& channel : status.channels) {
    result.readings.push_back(channel.reading);
    result.statistics.push_back(channel.statistics);
  }
  return result;
}

void InProcessPort::pass(double seconds) { device().advance(seconds); }

InProcessPort::Assemble assemble_with(const Catalog& catalog,
                                      std::shared_ptr<const FluxIntegrator> integrator) {
  if (!integrator) {
    integrator = std::make_shared<ApertureIntegrator>();
  }
  return [catalog, integrator](const Instrument& instrument, const std::vector<std::string>& ids) {
    const WavelengthGrid grid = WavelengthGrid::visible();
    std::vector<Sample> samples;
    samples.reserve(ids.size());
    for (const std::string& id : ids) {
      samples.push_back(load_sample(catalog.find(Catalog::Kind::sample, id), grid));
    }
    const Glossmeter glossmeter(instrument, grid, integrator);
    return assemble_device(glossmeter, instrument.behaviour, samples, tolerance_gu);
  };
}

}  // namespace gonio::conformance
