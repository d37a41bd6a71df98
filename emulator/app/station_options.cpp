#include "emulator/app/station_options.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <variant>

#include "emulator/app/command.hpp"
#include "emulator/instrument/assembly.hpp"
#include "emulator/instrument/settings.hpp"
#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/procedure/measure.hpp"

namespace gonio::app {

namespace {

/// What is laid on the port at first: a word, or the id of a sample.
void place(Device& device, const std::string& what) {
  if (what == "nothing") {
    return;
  }
  if (what == "tile" || what == "black_trap") {
    device.place(what == "tile" ? PortCover::tile : PortCover::black_trap);
    return;
  }
  std::string known = "nothing, tile, black_trap";
  for (std::size_t j = 0; j < device.samples().size(); ++j) {
    if (device.samples()[j].id == what) {
      device.place(PortCover::sample, int(j));
      return;
    }
    known += fmt::format(", {}", device.samples()[j].id);
  }
  throw std::invalid_argument(fmt::format("--place: expected one of {}, found '{}'", known, what));
}

std::vector<Sample> load_samples(const StationOptions& options, const Instrument& instrument,
                                 const Catalog& catalog, const WavelengthGrid& grid) {
  std::vector<Sample> samples;
  if (options.samples.empty()) {
    for (const auto& file : instrument.samples) {
      samples.push_back(load_sample(file, grid));
    }
  }
  for (const std::string& sample : options.samples) {
    samples.push_back(load_sample(catalog.find(Catalog::Kind::sample, sample), grid));
  }
  return samples;
}

Device make_device(const StationOptions& options, const std::vector<TimedFault>& faults,
                   const Instrument& instrument, const Catalog& catalog) {
  const WavelengthGrid grid = WavelengthGrid::visible();
  const Glossmeter glossmeter(instrument, grid, std::make_shared<ApertureIntegrator>());
  Behaviour behaviour = options.is_ideal ? instrument.behaviour.ideal() : instrument.behaviour;
  behaviour.seed = options.seed.value_or(behaviour.seed);
  behaviour.faults.insert(behaviour.faults.end(), faults.begin(), faults.end());
  Device device =
      assemble_device(glossmeter, std::move(behaviour),
                      load_samples(options, instrument, catalog, grid), MeasureOptions{}.tolerance);
  place(device, options.place);
  return device;
}

void keep_settings(Device& device, const std::filesystem::path& folder, const std::string& name) {
  std::filesystem::create_directories(folder);
  const std::filesystem::path file = folder / (name + ".yaml");
  std::vector<std::string> geometry_ids;
  for (const Channel& channel : device.channels()) {
    geometry_ids.push_back(channel.geometry_id);
  }
  std::optional<DeviceSettings> saved;
  if (std::filesystem::exists(file)) {
    saved = load_settings(file, geometry_ids);
  }
  device.keep_settings(
      [=](const DeviceSettings& settings) { save_settings(file, settings, geometry_ids); }, saved);
}

/// The faults of the command line: of the wire, and of every instrument.
struct Faults {
  std::vector<FaultRule> wire;
  std::vector<TimedFault> instrument;
};

Faults parse_faults(const std::vector<std::string>& texts) {
  Faults faults;
  for (const std::string& text : texts) {
    const auto fault = read_any_fault(YamlNode::parse(text, "--fault"));
    if (const auto* rule = std::get_if<FaultRule>(&fault)) {
      faults.wire.push_back(*rule);
    } else {
      faults.instrument.push_back(std::get<TimedFault>(fault));
    }
  }
  return faults;
}

}  // namespace

std::unique_ptr<Station> make_station(const StationOptions& options, const Catalog& catalog) {
  if (!options.units.empty() && options.units.size() != options.instruments.size()) {
    throw std::invalid_argument(
        fmt::format("--unit: expected one for each instrument, {} in all, found {}",
                    options.instruments.size(), options.units.size()));
  }
  std::vector<Station::Member> members;
  Faults faults = parse_faults(options.faults);
  for (std::size_t j = 0; j < options.instruments.size(); ++j) {
    const Instrument instrument =
        load_instrument(catalog.find(Catalog::Kind::instrument, options.instruments[j]), catalog);
    WireOptions wire{.unit = int(j) + 1};
    if (instrument.wire) {
      wire = read_wire(*instrument.wire);
    }
    const int unit = options.units.empty() ? wire.unit : options.units[j];
    for (FaultRule& rule : wire.faults) {
      rule.unit = static_cast<std::uint8_t>(unit);
      faults.wire.push_back(rule);
    }
    members.push_back({.id = static_cast<std::uint8_t>(unit),
                       .device = make_device(options, faults.instrument, instrument, catalog)});
    if (options.state_folder) {
      keep_settings(members.back().device, *options.state_folder,
                    fmt::format("{}_{}", instrument.id, unit));
    }
  }
  auto station = std::make_unique<Station>(
      std::move(members),
      InstrumentUnit::Options{.has_simulation_registers = !options.has_no_simulation,
                              .firmware_version = GONIO_VERSION},
      options.seed.value_or(1), options.speed);
  for (const FaultRule& rule : faults.wire) {
    station->faults().add(rule);
  }
  return station;
}

void add_station_options(CLI::App& command, StationOptions& options) {
  command.add_option("INSTRUMENT", options.instruments, "Instruments as built: files or ids")
      ->required();
  command
      .add_option("--unit", options.units,
                  "Unit ids, one for each instrument; else those of the files, or 1, 2, ...")
      ->check(CLI::Range(1, 247));
  command.add_option("--sample", options.samples,
                     "What can be laid on the port, instead of the samples of the instrument");
  command
      .add_option("--place", options.place,
                  "What lies on the port at first: nothing, tile, black_trap or a sample's id")
      ->capture_default_str();
  command.add_flag("--ideal", options.is_ideal,
                   "No noise, drift, warm-up and resolution: reads what `gonio measure` computes");
  command.add_option("--seed", options.seed, "Of noise and of faults, instead of the instrument's")
      ->check(number_in(Range::closed(0.0, 1e18)));
  command
      .add_option("--speed", options.speed, "Seconds of the instrument in a second of the world")
      ->check(number_in(Range::closed(1e-3, 1e5)))
      ->capture_default_str();
  command.add_option("--state", options.state_folder,
                     "Folder where settings are saved; without it they cannot be");
  command.add_option("--fault", options.faults,
                     "Fault on demand, e.g. '{fault: exception, code: 6, function: 3, count: 2}'");
  command.add_flag("--no-simulation", options.has_no_simulation,
                   "Without the registers that a real instrument has not");
}

}  // namespace gonio::app
