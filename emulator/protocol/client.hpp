#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "emulator/protocol/device_url.hpp"
#include "emulator/protocol/modbus.hpp"

namespace gonio {

/// What an exception code means, e.g. "illegal data address".
[[nodiscard]] std::string words_for(modbus::Exception code);

/// A device understood what was asked, and says no; what() says why.
class DeviceRefusal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A device answered with an exception. what() names it in words.
class ModbusExceptionError : public DeviceRefusal {
 public:
  /// @param asked  of which device, and what.
  ModbusExceptionError(const std::string& asked, modbus::Exception code);
  [[nodiscard]] modbus::Exception code() const { return code_; }

 private:
  modbus::Exception code_;
};

/// A Modbus client on libmodbus, over TCP and RTU. After an error the next request begins on a new
/// connection, or an emptied line: what is still under way is nobody's answer.
class ModbusClient {
 public:
  /// Connects. @param timeout  of a connection, and of each answer.
  /// @throws std::system_error  with the URL if that fails.
  ModbusClient(const DeviceUrl& url, std::chrono::milliseconds timeout);
  ~ModbusClient();
  ModbusClient(ModbusClient&&) noexcept;
  ModbusClient& operator=(ModbusClient&&) noexcept;

  /// Any number of registers, in as few requests as the protocol allows, within one request up to
  /// 125. @throws ModbusExceptionError  if the device answers with an exception,
  /// std::system_error  for no or a wrong answer.
  [[nodiscard]] std::vector<std::uint16_t> read_registers(modbus::Table table,
                                                          std::uint16_t address, int count);
  [[nodiscard]] std::vector<bool> read_bits(modbus::Table table, std::uint16_t address, int count);
  /// In one request. @param values  1 to 123. @throws std::invalid_argument  for more or none.
  void write_registers(std::uint16_t address, const std::vector<std::uint16_t>& values);
  void write_coil(std::uint16_t address, bool value);

  [[nodiscard]] const DeviceUrl& url() const;

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

}  // namespace gonio
