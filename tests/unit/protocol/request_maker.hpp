#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>

#include "emulator/protocol/modbus.hpp"
#include "emulator/protocol/wire_number.hpp"
#include "tests/unit/hex.hpp"

namespace gonio::test {

/// Requests, most of them almost right: random bytes alone would hardly get past the first check.
class RequestMaker {
 public:
  /// For a unit whose tables have `places` places from `first` on.
  RequestMaker(unsigned seed, int first, int places)
      : random_(seed), first_(first), places_(places) {}

  Bytes next() {
    Bytes request = is_one_in(20) ? noise(std::size_t(uniform(1, 253))) : good();
    for (int mutations = is_one_in(3) ? uniform(1, 3) : 0; mutations > 0; --mutations) {
      mutate(request);
    }
    return request;
  }

 private:
  int uniform(int low, int high) { return std::uniform_int_distribution(low, high)(random_); }
  bool is_one_in(int n) { return uniform(1, n) == 1; }
  template <std::size_t size>
  std::uint8_t any_of(const std::array<std::uint8_t, size>& values) {
    return values[std::size_t(uniform(0, int(size) - 1))];
  }
  std::uint8_t byte() { return static_cast<std::uint8_t>(uniform(0, 255)); }

  Bytes noise(std::size_t count) {
    Bytes bytes(count);
    std::generate(bytes.begin(), bytes.end(), [&] { return byte(); });
    return bytes;
  }

  /// Mostly within the tables, often at an edge.
  int address() {
    switch (uniform(0, 7)) {
      case 0:
        return first_ + uniform(-2, 2);
      case 1:
        return first_ + places_ + uniform(-3, 1);
      case 2:
        return uniform(0, 65535);
      default:
        return first_ + uniform(0, places_ - 200);
    }
  }
  /// Mostly small, often about the limit.
  int count(int limit) {
    switch (uniform(0, 5)) {
      case 0:
        return limit + uniform(-1, 1);
      case 1:
        return uniform(0, limit);
      case 2:
        return is_one_in(4) ? uniform(0, 65535) : uniform(0, 1);
      default:
        return uniform(1, 20);
    }
  }

  static void append_u16(Bytes& bytes, int value) {
    bytes.push_back(modbus::high_byte(static_cast<std::uint16_t>(value)));
    bytes.push_back(modbus::low_byte(static_cast<std::uint16_t>(value)));
  }
  /// Byte count and data, as far as a PDU has room; at times a byte too many.
  void append_data(Bytes& bytes, int size) {
    size += is_one_in(50) ? 1 : 0;
    bytes.push_back(static_cast<std::uint8_t>(size));
    const Bytes data = noise(std::min(std::size_t(size), modbus::max_pdu - bytes.size()));
    bytes.insert(bytes.end(), data.begin(), data.end());
  }

  Bytes good() {
    constexpr std::array<std::uint8_t, 10> of_tables = {1, 2, 3, 4, 5, 6, 15, 16, 22, 23};
    constexpr std::array<std::uint8_t, 6> others = {7, 8, 17, 20, 43, 0x83};
    Bytes pdu = {is_one_in(10) ? any_of(others) : any_of(of_tables)};
    switch (pdu[0]) {
      case 7:
      case 17:
        return pdu;
      case 43:
        pdu.push_back(is_one_in(10) ? byte() : 14);
        append_u16(pdu, uniform(0, 5) << 8 | uniform(0, 8));
        return pdu;
      default:
        append_u16(pdu, address());
        append_operands(pdu);
        return pdu;
    }
  }
  void append_operands(Bytes& pdu) {
    const int count_of_bits = count(pdu[0] == 15 ? 1968 : 2000);
    const int count_of_registers = count(pdu[0] == 16 ? 123 : 125);
    switch (pdu[0]) {
      case 1:
      case 2:
        append_u16(pdu, count_of_bits);
        break;
      case 3:
      case 4:
        append_u16(pdu, count_of_registers);
        break;
      case 5:
        append_u16(pdu, is_one_in(4) ? uniform(0, 65535) : uniform(0, 1) * 0xFF00);
        break;
      case 15:
        append_u16(pdu, count_of_bits);
        append_data(pdu, (count_of_bits + 7) / 8);
        break;
      case 16:
        append_u16(pdu, count_of_registers);
        append_data(pdu, 2 * count_of_registers);
        break;
      case 22:
        append_u16(pdu, uniform(0, 65535));
        append_u16(pdu, uniform(0, 65535));
        break;
      case 23: {
        const int count_to_write = count(121);
        append_u16(pdu, count_of_registers);
        append_u16(pdu, address());
        append_u16(pdu, count_to_write);
        append_data(pdu, 2 * count_to_write);
        break;
      }
      default:
        append_u16(pdu, uniform(0, 65535));
    }
  }

  void mutate(Bytes& request) {
    std::uint8_t& any = request[std::size_t(uniform(0, int(request.size()) - 1))];
    switch (uniform(0, 4)) {
      case 0:
        any = byte();
        break;
      case 1:
        any = static_cast<std::uint8_t>(any ^ 1U << uniform(0, 7));
        break;
      case 2:
        any = static_cast<std::uint8_t>(any + uniform(-1, 1));
        break;
      case 3:
        request.resize(std::size_t(uniform(1, int(request.size()))));
        break;
      default:
        request.resize(std::min(modbus::max_pdu, request.size() + std::size_t(uniform(1, 4))),
                       byte());
    }
  }

  std::mt19937 random_;
  int first_, places_;
};

}  // namespace gonio::test
