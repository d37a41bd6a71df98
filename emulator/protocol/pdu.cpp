#include "emulator/protocol/pdu.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "emulator/protocol/device_identification.hpp"
#include "emulator/protocol/wire_number.hpp"

namespace gonio::modbus {

namespace {

using Request = std::span<const std::uint8_t>;

/// Appends the reply to `reply`, which holds the function code.
using Handler = Exception (*)(Request request, Unit& unit, Pdu& reply);

bool is_within(std::size_t value, std::size_t low, std::size_t high) {
  return value >= low && value <= high;
}

/// Whether addresses stay within 16 bits; a unit need not think of others.
bool is_addressable(std::uint16_t address, std::size_t count) { return address + count <= 65536; }

Exception check_range(const Unit& unit, Table table, std::uint16_t address, std::size_t count) {
  return is_addressable(address, count) ? unit.check(table, address, count)
                                        : Exception::illegal_data_address;
}

void append_registers(Table table, std::uint16_t address, std::size_t count, Unit& unit,
                      Pdu& reply) {
  std::array<std::uint16_t, max_read_registers> registers;
  const std::span values = std::span(registers).first(count);
  unit.read_registers(table, address, values);
  reply.append(static_cast<std::uint8_t>(2 * count));
  std::uint8_t* out = reply.extend(2 * count).data();
  for (const std::uint16_t value : values) {
    *out++ = high_byte(value);
    *out++ = low_byte(value);
  }
}

template <Table table>
Exception read_registers(Request request, Unit& unit, Pdu& reply) {
  if (request.size() != 5) {
    return Exception::illegal_data_value;
  }
  const std::uint16_t address = u16_at(request, 1), count = u16_at(request, 3);
  if (!is_within(count, 1, max_read_registers)) {
    return Exception::illegal_data_value;
  }
  const Exception refusal = check_range(unit, table, address, count);
  if (refusal == Exception::none) {
    append_registers(table, address, count, unit, reply);
  }
  return refusal;
}

template <Table table>
Exception read_bits(Request request, Unit& unit, Pdu& reply) {
  if (request.size() != 5) {
    return Exception::illegal_data_value;
  }
  const std::uint16_t address = u16_at(request, 1), count = u16_at(request, 3);
  if (!is_within(count, 1, max_read_bits)) {
    return Exception::illegal_data_value;
  }
  const Exception refusal = check_range(unit, table, address, count);
  if (refusal != Exception::none) {
    return refusal;
  }
  std::array<std::uint8_t, max_read_bits> bits;
  unit.read_bits(table, address, std::span(bits).first(count));
  const std::size_t bytes = (count + 7U) / 8U;
  reply.append(static_cast<std::uint8_t>(bytes));
  const std::span<std::uint8_t> packed = reply.extend(bytes);
  std::fill(packed.begin(), packed.end(), std::uint8_t{0});
  for (std::size_t i = 0; i < count; ++i) {
    packed[i / 8] |= static_cast<std::uint8_t>(unsigned{bits[i] != 0} << (i % 8));
  }
  return Exception::none;
}

/// Replies with the first bytes of the request after its function code.
Exception echo(Request request, std::size_t bytes, Exception outcome, Pdu& reply) {
  if (outcome == Exception::none) {
    reply.append(request.subspan(1, bytes));
  }
  return outcome;
}

Exception write_single_coil(Request request, Unit& unit, Pdu& reply) {
  constexpr std::uint16_t off = 0x0000, on = 0xFF00;
  if (request.size() != 5) {
    return Exception::illegal_data_value;
  }
  const std::uint16_t value = u16_at(request, 3);
  if (value != off && value != on) {
    return Exception::illegal_data_value;
  }
  const std::array<std::uint8_t, 1> bit = {static_cast<std::uint8_t>(value == on)};
  return echo(request, 4, unit.write_coils(u16_at(request, 1), bit), reply);
}

Exception write_single_register(Request request, Unit& unit, Pdu& reply) {
  if (request.size() != 5) {
    return Exception::illegal_data_value;
  }
  const std::array<std::uint16_t, 1> value = {u16_at(request, 3)};
  return echo(request, 4, unit.write_registers(u16_at(request, 1), value), reply);
}

Exception write_multiple_coils(Request request, Unit& unit, Pdu& reply) {
  if (request.size() < 6) {
    return Exception::illegal_data_value;
  }
  const std::uint16_t address = u16_at(request, 1), count = u16_at(request, 3);
  const std::size_t bytes = (count + 7U) / 8U;
  if (!is_within(count, 1, max_write_bits) || request[5] != bytes || request.size() != 6 + bytes) {
    return Exception::illegal_data_value;
  }
  if (!is_addressable(address, count)) {
    return Exception::illegal_data_address;
  }
  std::array<std::uint8_t, max_write_bits> bits;
  for (std::size_t i = 0; i < count; ++i) {
    bits[i] = request[6 + i / 8] >> (i % 8) & 1U;
  }
  return echo(request, 4, unit.write_coils(address, std::span(bits).first(count)), reply);
}

/// Writes the registers whose bytes are `values`.
Exception write_registers_of(std::uint16_t address, Request values, Unit& unit) {
  std::array<std::uint16_t, max_write_registers> registers;
  const std::size_t count = values.size() / 2;
  for (std::size_t i = 0; i < count; ++i) {
    registers[i] = u16_at(values, 2 * i);
  }
  return is_addressable(address, count)
             ? unit.write_registers(address, std::span(registers).first(count))
             : Exception::illegal_data_address;
}

Exception write_multiple_registers(Request request, Unit& unit, Pdu& reply) {
  if (request.size() < 6) {
    return Exception::illegal_data_value;
  }
  const std::size_t count = u16_at(request, 3);
  if (!is_within(count, 1, max_write_registers) || request[5] != 2 * count ||
      request.size() != 6 + 2 * count) {
    return Exception::illegal_data_value;
  }
  return echo(request, 4, write_registers_of(u16_at(request, 1), request.subspan(6), unit), reply);
}

Exception mask_write_register(Request request, Unit& unit, Pdu& reply) {
  if (request.size() != 7) {
    return Exception::illegal_data_value;
  }
  const std::uint16_t address = u16_at(request, 1);
  const std::uint16_t and_mask = u16_at(request, 3), or_mask = u16_at(request, 5);
  const Exception refusal = unit.check(Table::holding_registers, address, 1);
  if (refusal != Exception::none) {
    return refusal;
  }
  std::array<std::uint16_t, 1> value;
  unit.read_registers(Table::holding_registers, address, value);
  value[0] = static_cast<std::uint16_t>((value[0] & and_mask) | (or_mask & ~and_mask));
  return echo(request, 6, unit.write_registers(address, value), reply);
}

/// The write comes first: what is read may be what was written.
Exception read_write_multiple_registers(Request request, Unit& unit, Pdu& reply) {
  if (request.size() < 10) {
    return Exception::illegal_data_value;
  }
  const std::uint16_t read_address = u16_at(request, 1), read_count = u16_at(request, 3);
  const std::uint16_t write_address = u16_at(request, 5), write_count = u16_at(request, 7);
  if (!is_within(read_count, 1, max_read_registers) ||
      !is_within(write_count, 1, max_write_registers_when_reading) ||
      request[9] != 2 * write_count || request.size() != 10U + 2U * write_count) {
    return Exception::illegal_data_value;
  }
  Exception refusal = check_range(unit, Table::holding_registers, read_address, read_count);
  if (refusal == Exception::none) {
    refusal = write_registers_of(write_address, request.subspan(10), unit);
  }
  if (refusal == Exception::none) {
    append_registers(Table::holding_registers, read_address, read_count, unit, reply);
  }
  return refusal;
}

/// Of the sub-functions only 0, which returns what it was sent.
Exception diagnostics(Request request, Unit& /*unit*/, Pdu& reply) {
  if (request.size() < 3) {
    return Exception::illegal_data_value;
  }
  if (u16_at(request, 1) != 0) {
    return Exception::illegal_function;
  }
  const bool has_whole_words = request.size() >= 5 && request.size() % 2 == 1;
  return echo(request, request.size() - 1,
              has_whole_words ? Exception::none : Exception::illegal_data_value, reply);
}

Exception report_server_id(Request request, Unit& unit, Pdu& reply) {
  if (request.size() != 1) {
    return Exception::illegal_data_value;
  }
  append_server_id(unit.identification(), reply);
  return Exception::none;
}

Exception encapsulated_interface(Request request, Unit& unit, Pdu& reply) {
  constexpr std::uint8_t read_device_identification = 14;
  if (request.size() < 2) {
    return Exception::illegal_data_value;
  }
  if (request[1] != read_device_identification) {
    return Exception::illegal_function;
  }
  if (request.size() != 4) {
    return Exception::illegal_data_value;
  }
  reply.append(read_device_identification);
  return append_device_identification(unit.identification(), request[2], request[3], reply);
}

constexpr auto handlers = [] {
  std::array<Handler, 256> by_code{};
  const auto set = [&](FunctionCode code, Handler handler) {
    by_code[static_cast<std::size_t>(code)] = handler;
  };
  set(FunctionCode::read_coils, read_bits<Table::coils>);
  set(FunctionCode::read_discrete_inputs, read_bits<Table::discrete_inputs>);
  set(FunctionCode::read_holding_registers, read_registers<Table::holding_registers>);
  set(FunctionCode::read_input_registers, read_registers<Table::input_registers>);
  set(FunctionCode::write_single_coil, write_single_coil);
  set(FunctionCode::write_single_register, write_single_register);
  set(FunctionCode::diagnostics, diagnostics);
  set(FunctionCode::write_multiple_coils, write_multiple_coils);
  set(FunctionCode::write_multiple_registers, write_multiple_registers);
  set(FunctionCode::report_server_id, report_server_id);
  set(FunctionCode::mask_write_register, mask_write_register);
  set(FunctionCode::read_write_multiple_registers, read_write_multiple_registers);
  set(FunctionCode::encapsulated_interface, encapsulated_interface);
  return by_code;
}();

constexpr bool is_of_serial_line_only(std::uint8_t code) {
  return code == static_cast<std::uint8_t>(FunctionCode::diagnostics) ||
         code == static_cast<std::uint8_t>(FunctionCode::report_server_id);
}

void write_exception(std::uint8_t function_code, Exception exception, Pdu& reply) {
  reply.clear();
  reply.append(function_code | 0x80U);
  reply.append(static_cast<std::uint8_t>(exception));
}

}  // namespace

void Pdu::append_u16(std::uint16_t value) {
  const std::span<std::uint8_t> out = extend(2);
  out[0] = high_byte(value);
  out[1] = low_byte(value);
}

void Pdu::append(std::span<const std::uint8_t> bytes) {
  const std::span<std::uint8_t> out = extend(bytes.size());
  std::copy(bytes.begin(), bytes.end(), out.begin());
}

std::span<std::uint8_t> Pdu::extend(std::size_t count) {
  if (count > max_pdu - size_) {
    throw std::length_error(fmt::format("Pdu: {} bytes, at most {}", size_ + count, max_pdu));
  }
  size_ += count;
  return std::span(bytes_).subspan(size_ - count, count);
}

Pdu exception_pdu(std::uint8_t function_code, Exception exception) {
  Pdu reply;
  write_exception(function_code, exception, reply);
  return reply;
}

Pdu answer(std::span<const std::uint8_t> request, Unit& unit, Line line) {
  if (!is_within(request.size(), 1, max_pdu)) {
    throw std::invalid_argument(
        fmt::format("answer: request of {} bytes, expected 1 to {}", request.size(), max_pdu));
  }
  const std::uint8_t code = request[0];
  const Handler handler =
      line == Line::tcp && is_of_serial_line_only(code) ? nullptr : handlers[code];
  Pdu reply;
  reply.append(code);
  const Exception refusal =
      handler == nullptr ? Exception::illegal_function : handler(request, unit, reply);
  if (refusal != Exception::none) {
    write_exception(code, refusal, reply);
  }
  return reply;
}

}  // namespace gonio::modbus
