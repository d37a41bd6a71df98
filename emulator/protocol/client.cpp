#include "emulator/protocol/client.hpp"

#include <fmt/format.h>
#include <modbus/modbus.h>
#include <netdb.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

namespace gonio {

namespace {

constexpr int most_registers = modbus::max_read_registers, most_bits = modbus::max_read_bits;
constexpr int most_written = modbus::max_write_registers;
constexpr int highest_exception = 11;

/// The errors that libmodbus adds to those of the system.
class ModbusCategory : public std::error_category {
 public:
  [[nodiscard]] const char* name() const noexcept override { return "modbus"; }
  [[nodiscard]] std::string message(int code) const override { return modbus_strerror(code); }
};

/// The errors of getaddrinfo.
class HostNameCategory : public std::error_category {
 public:
  [[nodiscard]] const char* name() const noexcept override { return "host name"; }
  [[nodiscard]] std::string message(int code) const override { return gai_strerror(code); }
};

/// @param code  of errno after a call of libmodbus.
[[noreturn]] void fail(int code, const std::string& what) {
  static const ModbusCategory category;
  if (code > MODBUS_ENOBASE) {
    throw std::system_error(code, category, what);
  }
  throw std::system_error(code, std::generic_category(), what);
}

/// libmodbus reports a name that is unknown as a connection that was refused.
void expect_known_host(const DeviceUrl& url) {
  static const HostNameCategory category;
  addrinfo* addresses = nullptr;
  if (const int error = getaddrinfo(url.host.c_str(), nullptr, nullptr, &addresses); error != 0) {
    throw std::system_error(error, category, url.text());
  }
  freeaddrinfo(addresses);
}

std::string range_text(std::string_view what, int address, int count) {
  return count == 1 ? fmt::format("{} {}", what, address)
                    : fmt::format("{}s {} to {}", what, address, address + count - 1);
}

modbus_t* new_context(const DeviceUrl& url) {
  // On a line without parity a second stop bit takes its place.
  return url.is_rtu
             ? modbus_new_rtu(url.path.c_str(), url.baud, url.parity, 8, url.parity == 'N' ? 2 : 1)
             : modbus_new_tcp_pi(url.host.c_str(), std::to_string(url.port).c_str());
}

}  // namespace

std::string words_for(modbus::Exception code) {
  constexpr std::array<const char*, highest_exception + 1> words = {
      "no exception",       "illegal function",         "illegal data address",
      "illegal data value", "device failure",           "acknowledged, not done yet",
      "device busy",        "negative acknowledge",     "memory parity error",
      "unknown exception",  "gateway path unavailable", "no answer behind the gateway"};
  const auto index = static_cast<std::size_t>(code);
  return index < words.size() ? words.at(index) : "unknown exception";
}

ModbusExceptionError::ModbusExceptionError(const std::string& asked, modbus::Exception code)
    : DeviceRefusal(fmt::format("{}: the device answered with exception {:02X}, {}", asked,
                                static_cast<int>(code), words_for(code))),
      code_(code) {}

struct ModbusClient::Context {
  Context(const DeviceUrl& device, std::chrono::milliseconds timeout)
      : url(device), modbus(new_context(device)) {
    if (!modbus || modbus_set_slave(modbus.get(), url.unit) != 0) {
      fail(errno, url.text());
    }
    const auto microseconds = std::chrono::microseconds(timeout).count();
    modbus_set_response_timeout(modbus.get(), static_cast<std::uint32_t>(microseconds / 1'000'000),
                                static_cast<std::uint32_t>(microseconds % 1'000'000));
    // The timeout above is then that of a whole answer, however it is split.
    modbus_set_byte_timeout(modbus.get(), 0, 0);
  }
  ~Context() { close(); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  void connect() {
    if (!url.is_rtu) {
      expect_known_host(url);
    }
    if (modbus_connect(modbus.get()) != 0) {
      fail(errno, fmt::format("{}: cannot connect", url.text()));
    }
    is_connected = true;
  }

  void close() {
    if (is_connected) {
      modbus_close(modbus.get());
      is_connected = false;
    }
  }

  /// @param call  a function of libmodbus, which returns -1 and sets errno if it fails.
  template <class Call>
  void request(const std::string& asked, Call&& call) {
    if (!is_connected) {
      connect();
    } else if (is_line_suspect) {
      modbus_flush(modbus.get());
    }
    is_line_suspect = false;
    errno = 0;
    if (call(modbus.get()) != -1) {
      return;
    }
    const int error = errno;
    const std::string what = fmt::format("{}: {}", url.text(), asked);
    const int code = error - MODBUS_ENOBASE;
    if (code > 0 && code <= highest_exception) {
      throw ModbusExceptionError(what, static_cast<modbus::Exception>(code));
    }
    // What still comes belongs to no request. A serial line stays open unless it broke.
    is_line_suspect = url.is_rtu && (error == ETIMEDOUT || error > MODBUS_ENOBASE);
    if (!is_line_suspect) {
      close();
    }
    fail(error, what);
  }

  struct Free {
    void operator()(modbus_t* context) const { modbus_free(context); }
  };
  DeviceUrl url;
  std::unique_ptr<modbus_t, Free> modbus;
  bool is_connected = false;
  bool is_line_suspect = false;
};

ModbusClient::ModbusClient(const DeviceUrl& url, std::chrono::milliseconds timeout)
    : context_(std::make_unique<Context>(url, timeout)) {
  context_->connect();
}

ModbusClient::~ModbusClient() = default;
ModbusClient::ModbusClient(ModbusClient&&) noexcept = default;
ModbusClient& ModbusClient::operator=(ModbusClient&&) noexcept = default;

const DeviceUrl& ModbusClient::url() const { return context_->url; }

std::vector<std::uint16_t> ModbusClient::read_registers(modbus::Table table, std::uint16_t address,
                                                        int count) {
  const bool is_input = table == modbus::Table::input_registers;
  std::vector<std::uint16_t> values(static_cast<std::size_t>(count));
  for (int done = 0; done < count; done += most_registers) {
    const int first = address + done, n = std::min(most_registers, count - done);
    context_->request(
        range_text(is_input ? "read input register" : "read holding register", first, n),
        [&](modbus_t* modbus) {
          return (is_input ? modbus_read_input_registers : modbus_read_registers)(
              modbus, first, n, values.data() + done);
        });
  }
  return values;
}

std::vector<bool> ModbusClient::read_bits(modbus::Table table, std::uint16_t address, int count) {
  const bool is_input = table == modbus::Table::discrete_inputs;
  std::vector<std::uint8_t> values(static_cast<std::size_t>(count));
  for (int done = 0; done < count; done += most_bits) {
    const int first = address + done, n = std::min(most_bits, count - done);
    context_->request(range_text(is_input ? "read discrete input" : "read coil", first, n),
                      [&](modbus_t* modbus) {
                        return (is_input ? modbus_read_input_bits : modbus_read_bits)(
                            modbus, first, n, values.data() + done);
                      });
  }
  return {values.begin(), values.end()};
}

void ModbusClient::write_registers(std::uint16_t address,
                                   const std::vector<std::uint16_t>& values) {
  const int count = static_cast<int>(values.size());
  if (count < 1 || count > most_written) {
    throw std::invalid_argument(
        fmt::format("write_registers: expected 1 to {} values, found {}", most_written, count));
  }
  context_->request(range_text("write holding register", address, count), [&](modbus_t* modbus) {
    return modbus_write_registers(modbus, address, count, values.data());
  });
}

void ModbusClient::write_coil(std::uint16_t address, bool value) {
  context_->request(range_text("write coil", address, 1), [&](modbus_t* modbus) {
    return modbus_write_bit(modbus, address, value ? TRUE : FALSE);
  });
}

}  // namespace gonio
