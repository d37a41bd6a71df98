#include "emulator/protocol/device_identification.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

namespace gonio::modbus {

namespace {

enum ReadCode : std::uint8_t { basic = 1, regular = 2, extended = 3, individual = 4 };

constexpr std::uint8_t conformity = 0x83;  // extended, by stream and by object
constexpr std::array<std::uint8_t, 4> last_object = {0, 0x02, 0x7F, 0xFF};  // by read code
constexpr std::size_t object_header = 2;                                    // number and length
constexpr std::size_t max_text = 244;  // what one reply holds after the headers

std::string_view text_of(const std::string& object) {
  return std::string_view(object).substr(0, max_text);
}

void append_text(std::string_view text, Pdu& reply) {
  const std::span<std::uint8_t> out = reply.extend(text.size());
  std::copy(text.begin(), text.end(), out.begin());
}

void append_object(std::uint8_t number, std::string_view text, Pdu& reply) {
  reply.append(number);
  reply.append(static_cast<std::uint8_t>(text.size()));
  append_text(text, reply);
}

void append_header(std::uint8_t more_follows, std::uint8_t next, std::uint8_t count, Pdu& reply) {
  for (const std::uint8_t byte : {more_follows, next, count}) {
    reply.append(byte);
  }
}

void append_stream(const Identification& identification, std::uint8_t read_code,
                   std::uint8_t object, Pdu& reply) {
  const auto& objects = identification.objects;
  const auto end = objects.upper_bound(last_object[read_code]);
  auto first = objects.find(object);
  if (first == objects.end() || object > last_object[read_code]) {
    first = objects.begin();
  }
  std::size_t room = max_pdu - reply.size() - 3;
  auto next = first;
  std::uint8_t count = 0;
  for (; next != end && object_header + text_of(next->second).size() <= room; ++next, ++count) {
    room -= object_header + text_of(next->second).size();
  }
  const bool has_more = next != end;
  append_header(has_more ? 0xFF : 0, has_more ? next->first : 0, count, reply);
  for (auto it = first; it != next; ++it) {
    append_object(it->first, text_of(it->second), reply);
  }
}

}  // namespace

Exception append_device_identification(const Identification& identification, std::uint8_t read_code,
                                       std::uint8_t object, Pdu& reply) {
  if (read_code < basic || read_code > individual) {
    return Exception::illegal_data_value;
  }
  reply.append(read_code);
  reply.append(conformity);
  if (read_code != individual) {
    append_stream(identification, read_code, object, reply);
    return Exception::none;
  }
  const auto found = identification.objects.find(object);
  if (found == identification.objects.end()) {
    return Exception::illegal_data_address;
  }
  append_header(0, 0, 1, reply);
  append_object(object, text_of(found->second), reply);
  return Exception::none;
}

void append_server_id(const Identification& identification, Pdu& reply) {
  constexpr std::uint8_t id = 0x47, runs = 0xFF;
  std::string text;
  for (const auto& [number, object] : identification.objects) {
    if (number <= last_object[basic]) {
      text += (text.empty() ? "" : " ") + object;
    }
  }
  text.resize(std::min(text.size(), max_pdu - 4));
  reply.append(static_cast<std::uint8_t>(2 + text.size()));
  reply.append(id);
  reply.append(runs);
  append_text(text, reply);
}

}  // namespace gonio::modbus
