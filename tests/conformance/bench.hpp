#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/conformance/device_port.hpp"

namespace gonio::conformance {

/// Readings of one thing by one channel.
struct ChannelReadings {
  std::string geometry;
  std::vector<double> gloss_gu = {};
  bool is_over_range = false;  ///< any of them

  [[nodiscard]] ChannelStatistics statistics() const;
  [[nodiscard]] double mean_gu() const { return statistics().mean; }
  /// Standard deviation of one reading; 0 for a single one.
  [[nodiscard]] double deviation_gu() const { return statistics().standard_deviation; }
};

/// A device on the laboratory's bench: a port, and what one does with a glossmeter. The standard
/// tells which channel is which geometry.
class Bench {
 public:
  /// Makes the port when it is first needed.
  using Connect = std::function<DevicePort&()>;

  Bench(const Standard* standard, Connect connect)
      : standard_(standard), connect_(std::move(connect)) {}

  [[nodiscard]] DevicePort& port() { return connect_(); }
  /// Ids of the standard's geometries that this device has, with their channels.
  struct Geometry {
    std::string id;
    std::size_t channel;
  };
  [[nodiscard]] std::vector<Geometry> geometries();
  /// @return  the channel of that geometry; nothing if the device has none.
  [[nodiscard]] std::optional<std::size_t> channel(const std::string& geometry_id);

  /// Waits until it can measure, then finds its zero on the trap and calibrates on the tile; only
  /// once until forget().
  void prepare();
  /// What prepare() has done no longer holds.
  void forget() { is_prepared_ = false; }
  void wait_until_ready();

  /// Lays it on the port and reads it that often.
  [[nodiscard]] std::vector<ChannelReadings> read(PortCover cover, const std::string& sample,
                                                  int readings);
  /// Expanded uncertainty (k = 2) of the mean of such readings: their scatter, and the step of the
  /// display as it shows in all that was read so far. @see JCGM 100:2008, F.2.2.1
  [[nodiscard]] double expanded_uncertainty_gu(const ChannelReadings& readings) const;

  /// Runs a command that must succeed. @throws DeviceRefused  that says what it refused.
  void must(DeviceCommand command);

 private:
  const Standard* standard_;
  Connect connect_;
  bool is_prepared_ = false;
  double display_step_gu_ = 0.1;
};

}  // namespace gonio::conformance
