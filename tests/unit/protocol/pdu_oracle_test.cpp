// The PDU function beside libmodbus: the same requests to the same memory.

#include <gtest/gtest.h>
#include <modbus.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "emulator/protocol/pdu.hpp"
#include "emulator/protocol/tcp_framer.hpp"
#include "emulator/protocol/wire_number.hpp"
#include "tests/unit/hex.hpp"
#include "tests/unit/protocol/fake_unit.hpp"
#include "tests/unit/protocol/request_maker.hpp"

namespace gonio::modbus {
namespace {

using test::Bytes;
using test::hex;

constexpr std::uint16_t first_address = 0x0100;
constexpr std::uint16_t places = 2100;  // more than one request can read or write

/// libmodbus as a server of one connection, the other end of which is here too.
class Oracle {
 public:
  Oracle()
      : mapping_(modbus_mapping_new_start_address(first_address, places, first_address, places,
                                                  first_address, places, first_address, places),
                 modbus_mapping_free),
        context_(modbus_new_tcp(nullptr, 0), modbus_free) {
    std::array<int, 2> ends{};
    if (mapping_ == nullptr || context_ == nullptr ||
        ::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) != 0) {
      throw std::system_error(errno, std::generic_category(), "Oracle");
    }
    server_ = ends[0];
    client_ = ends[1];
    modbus_set_socket(context_.get(), server_);
    // It sleeps that long after a bad request: half a second unless told, and then the kernel's
    // slack of 50 us.
    modbus_set_response_timeout(context_.get(), 0, 1);
    ::prctl(PR_SET_TIMERSLACK, 1);
  }
  ~Oracle() {
    ::close(server_);
    ::close(client_);
  }
  Oracle(const Oracle&) = delete;
  Oracle& operator=(const Oracle&) = delete;

  /// The reply's PDU; empty for none.
  Bytes answer(std::span<const std::uint8_t> request) {
    // Always a whole buffer: libmodbus reads what a short request lacks from behind it.
    std::array<std::uint8_t, max_tcp_adu> adu{};
    const std::size_t size = write_tcp_frame(1, 1, request, adu);
    modbus_reply(context_.get(), adu.data(), static_cast<int>(size), mapping_.get());
    const ssize_t received = ::recv(client_, adu.data(), adu.size(), MSG_DONTWAIT);
    return received <= 7 ? Bytes{} : Bytes(adu.begin() + 7, adu.begin() + received);
  }

  void copy_memory_of(const test::FakeUnit& unit) {
    std::copy(unit.coils.values.begin(), unit.coils.values.end(), mapping_->tab_bits);
    std::copy(unit.discrete_inputs.values.begin(), unit.discrete_inputs.values.end(),
              mapping_->tab_input_bits);
    std::copy(unit.holding_registers.values.begin(), unit.holding_registers.values.end(),
              mapping_->tab_registers);
    std::copy(unit.input_registers.values.begin(), unit.input_registers.values.end(),
              mapping_->tab_input_registers);
  }
  [[nodiscard]] bool has_memory_of(const test::FakeUnit& unit) const {
    const auto is_equal = [](const auto& values, const auto* tab) {
      return std::equal(values.begin(), values.end(), tab);
    };
    return is_equal(unit.coils.values, mapping_->tab_bits) &&
           is_equal(unit.discrete_inputs.values, mapping_->tab_input_bits) &&
           is_equal(unit.holding_registers.values, mapping_->tab_registers) &&
           is_equal(unit.input_registers.values, mapping_->tab_input_registers);
  }

 private:
  std::unique_ptr<modbus_mapping_t, decltype(&modbus_mapping_free)> mapping_;
  std::unique_ptr<modbus_t, decltype(&modbus_free)> context_;
  int server_ = -1, client_ = -1;
};

/// Where libmodbus 3.1.6 differs for a reason.
struct Deviation {
  const char* reason;
  bool (*applies)(std::span<const std::uint8_t> request);
  std::string (*ours)(std::span<const std::uint8_t> request);  ///< how our reply begins
};

std::string exception(std::span<const std::uint8_t> request, int code) {
  return fmt::format("{:02X} {:02X}", request[0] | 0x80, code);
}

/// The length that a request says it has; 0 if it is too short to say.
std::size_t stated_size(std::span<const std::uint8_t> request) {
  const auto with_data = [&](std::size_t count_at) {
    return request.size() <= count_at ? 0 : count_at + 1 + request[count_at];
  };
  switch (request[0]) {
    case 15:
    case 16:
      return with_data(5);
    case 22:
      return 7;
    case 23:
      return with_data(9);
    default:
      return 5;
  }
}

bool is_of_tables(std::uint8_t code) {
  return (code >= 1 && code <= 6) || code == 15 || code == 16 || code == 22 || code == 23;
}

constexpr std::array deviations = {
    Deviation{"function code 7 is of the serial line: libmodbus gives no answer at all",
              [](auto request) { return request[0] == 7; },
              [](auto request) { return exception(request, 1); }},
    Deviation{"function code 17 is of the serial line: libmodbus tells its own version",
              [](auto request) { return request[0] == 17; },
              [](auto request) { return exception(request, 1); }},
    Deviation{"libmodbus has no function code 43/14", [](auto request) { return request[0] == 43; },
              [](auto request) {
                const bool is_good = request.size() == 4 && request[1] == 14 && request[2] >= 1 &&
                                     request[2] <= 4 && (request[2] != 4 || request[3] <= 2);
                return is_good ? fmt::format("2B 0E {:02X} 83", request[2]) : std::string("AB 0");
              }},
    Deviation{"libmodbus adds 80h to a function code that has the bit: it looks like a good reply",
              [](auto request) { return request[0] >= 0x80; },
              [](auto request) { return exception(request, 1); }},
    Deviation{"libmodbus takes no notice of bytes that are missing or left over",
              [](auto request) {
                return is_of_tables(request[0]) && request.size() != stated_size(request);
              },
              [](auto request) { return exception(request, 3); }},
    Deviation{"the value of a coil is judged before its address",
              [](auto request) {
                return request[0] == 5 && request.size() == 5 && u16_at(request, 3) != 0 &&
                       u16_at(request, 3) != 0xFF00;
              },
              [](auto request) { return exception(request, 3); }},
    Deviation{"libmodbus takes more bytes than the coils fill",
              [](auto request) {
                return request[0] == 15 && request.size() == stated_size(request) &&
                       request[5] > (u16_at(request, 3) + 7) / 8;
              },
              [](auto request) { return exception(request, 3); }},
};

class PduOracle : public testing::TestWithParam<unsigned> {};

// 250 000 requests for each of four seeds. The sanitizers look at fewer: they are slow, and look
// for other things.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int requests_per_seed = 25'000;
#else
constexpr int requests_per_seed = 250'000;
#endif

TEST_P(PduOracle, AgreesWithLibmodbusButForExplainedDeviations) {
  test::RequestMaker requests(GetParam(), first_address, places);
  Oracle oracle;
  test::FakeUnit unit(first_address, places);
  unit.identity.objects = {{0, "vendor"}, {1, "code"}, {2, "1.0"}};
  std::mt19937 random(GetParam());
  std::generate(unit.input_registers.values.begin(), unit.input_registers.values.end(),
                [&] { return static_cast<std::uint16_t>(random()); });
  std::generate(unit.discrete_inputs.values.begin(), unit.discrete_inputs.values.end(),
                [&] { return static_cast<std::uint8_t>(random() & 1U); });
  oracle.copy_memory_of(unit);

  std::array<int, deviations.size()> hits{};
  int normal_replies = 0;
  for (int i = 0; i < requests_per_seed; ++i) {
    const Bytes request = requests.next();
    const std::string theirs = hex(oracle.answer(request));
    const Pdu reply = answer(request, unit, Line::tcp);
    const std::string ours = hex(reply.bytes());
    if (ours == theirs && oracle.has_memory_of(unit)) {
      normal_replies += reply.is_exception() ? 0 : 1;
      continue;
    }
    const auto deviation = std::find_if(deviations.begin(), deviations.end(),
                                        [&](const Deviation& d) { return d.applies(request); });
    ASSERT_NE(deviation, deviations.end())
        << "request " << hex(request) << "\nours    " << ours << "\ntheirs  " << theirs;
    ASSERT_TRUE(ours.starts_with(deviation->ours(request)))
        << deviation->reason << "\nrequest " << hex(request) << "\nours    " << ours;
    ++hits[std::size_t(deviation - deviations.begin())];
    oracle.copy_memory_of(unit);
  }
  EXPECT_GT(normal_replies, requests_per_seed / 4) << "else it compares exceptions";
  for (std::size_t i = 0; i < deviations.size(); ++i) {
    EXPECT_GT(hits[i], 0) << "dead: " << deviations[i].reason;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, PduOracle, testing::Values(1U, 2U, 3U, 4U));

}  // namespace
}  // namespace gonio::modbus
