#pragma once

#include <cstddef>
#include <cstdint>

namespace gonio::modbus {

/// Sizes of the application protocol, in bytes.
inline constexpr std::size_t max_pdu = 253;
inline constexpr std::size_t max_tcp_adu = 260;
inline constexpr std::size_t max_rtu_adu = 256;

/// How many bits or registers one request can read or write.
inline constexpr std::size_t max_read_bits = 2000, max_write_bits = 1968;
inline constexpr std::size_t max_read_registers = 125, max_write_registers = 123;
inline constexpr std::size_t max_write_registers_when_reading = 121;

enum class FunctionCode : std::uint8_t {
  read_coils = 1,
  read_discrete_inputs = 2,
  read_holding_registers = 3,
  read_input_registers = 4,
  write_single_coil = 5,
  write_single_register = 6,
  diagnostics = 8,
  write_multiple_coils = 15,
  write_multiple_registers = 16,
  report_server_id = 17,
  mask_write_register = 22,
  read_write_multiple_registers = 23,
  encapsulated_interface = 43
};

enum class Exception : std::uint8_t {
  none = 0,
  illegal_function = 1,
  illegal_data_address = 2,
  illegal_data_value = 3,
  server_device_failure = 4,
  server_device_busy = 6,
  gateway_path_unavailable = 0x0A,
  gateway_target_failed = 0x0B
};

/// The four tables of a Modbus unit.
enum class Table { coils, discrete_inputs, holding_registers, input_registers };

/// Some function codes exist on a serial line only.
enum class Line { tcp, serial };

}  // namespace gonio::modbus
