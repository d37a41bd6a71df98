#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emulator/core/catalog.hpp"
#include "emulator/integration/flux.hpp"
#include "tests/conformance/device_port.hpp"

namespace gonio::conformance {

/// The emulator of an instrument, without a wire. Its time passes when it is told to; a command
/// takes as long as it takes the device, and no time of ours.
class InProcessPort final : public DevicePort {
 public:
  /// Builds the device of an instrument. @param samples  ids of what can be laid on its port.
  using Assemble =
      std::function<Device(const Instrument&, const std::vector<std::string>& samples)>;

  /// @param assemble  called when the device is first asked to do something: a set-up can be stated
  ///                  where nothing can be read, e.g. for want of an aperture.
  InProcessPort(Instrument instrument, std::vector<std::string> samples, Assemble assemble);

  [[nodiscard]] const Identity& identity() const override { return instrument_.identity; }
  [[nodiscard]] std::string where() const override;
  [[nodiscard]] const std::vector<PortChannel>& channels() const override { return channels_; }
  [[nodiscard]] std::optional<StatedAngle> setup(std::size_t channel,
                                                 SetupQuantity quantity) override;
  void place(PortCover cover, const std::string& sample) override;
  [[nodiscard]] DeviceError command(DeviceCommand command) override;
  [[nodiscard]] PortStatus status() override;
  void pass(double seconds) override;

 private:
  [[nodiscard]] Device& device();

  Instrument instrument_;
  std::vector<std::string> samples_;
  Assemble assemble_;
  std::vector<PortChannel> channels_;
  std::optional<Device> device_;
};

/// Builds devices. @param integrator  null: the aperture integrator, as in `gonio serve`.
[[nodiscard]] InProcessPort::Assemble assemble_with(
    const Catalog& catalog, std::shared_ptr<const FluxIntegrator> integrator = nullptr);

}  // namespace gonio::conformance
