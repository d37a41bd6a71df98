#include "tests/conformance/device_under_test.hpp"

#include <fmt/format.h>

#include "tests/conformance/in_process_port.hpp"
#include "tests/conformance/served_device.hpp"

namespace gonio::conformance {

namespace {

/// Assembles the device once; every case gets one as new.
InProcessPort::Assemble assemble_once(const Catalog& catalog) {
  auto made = std::make_shared<std::optional<Device>>();
  return [made, assemble = assemble_with(catalog)](const Instrument& instrument,
                                                   const std::vector<std::string>& samples) {
    if (!*made) {
      *made = assemble(instrument, samples);
    }
    return **made;
  };
}

DeviceUnderTest emulated(Instrument instrument, const ConformanceSuite& suite,
                         const Catalog& catalog) {
  const InProcessPort::Assemble assemble = assemble_once(catalog);
  const std::vector<std::string> samples = suite.device_samples();
  const Standard* standard = &*suite.set.standard;
  DeviceUnderTest device{.bench = {}, .instrument = instrument};
  device.title = fmt::format("{}, emulated in process", instrument.title);
  device.detail = instrument.file.empty() ? standard->file.string() : instrument.file.string();
  device.bench = [=, set = std::make_shared<Standard>(*standard)] {
    const auto port = std::make_shared<InProcessPort>(instrument, samples, assemble);
    return std::make_shared<Bench>(set.get(), [port]() -> DevicePort& { return *port; });
  };
  return device;
}

}  // namespace

void add_device_options(CLI::App& program, DeviceOptions& options) {
  program
      .add_option("--device", options.device,
                  "Whom to judge: nominal (what the standard says, emulated), an instrument as "
                  "built (file or id, emulated), or modbus://HOST[:PORT][/UNIT], "
                  "modbus-rtu:PATH")
      ->capture_default_str();
  program.add_option("--timeout", options.timeout, "Of an answer over Modbus")
      ->capture_default_str();
  program
      .add_option("--patience", options.patience,
                  "How long to wait while a device's own time passes, e.g. for its drift")
      ->capture_default_str();
  program
      .add_option("--profile", options.profile,
                  "What stands at which address of a server, for modbus: gonio, plain, or a file")
      ->capture_default_str();
  program.add_flag("--ask", options.asks, "Ask a person to lay samples on the port");
}

DeviceUnderTest find_device(const DeviceOptions& options, const ConformanceSuite& suite,
                            std::uint64_t seed, const Catalog& catalog) {
  if (is_device_url(options.device)) {
    return served_device(options, suite);
  }
  if (!suite.set.standard) {
    return {.bench = {}, .title = "no device", .detail = options.device};
  }
  Instrument instrument =
      options.device == "nominal"
          ? nominal_instrument(*suite.set.standard)
          : load_instrument(catalog.find(Catalog::Kind::instrument, options.device), catalog);
  expect_gloss(instrument);
  instrument.behaviour.seed = seed;
  return emulated(std::move(instrument), suite, catalog);
}

}  // namespace gonio::conformance
