#include "tests/conformance/probed_line.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <chrono>
#include <functional>

#include "tests/conformance/device_port.hpp"
#include "tests/conformance/wire_cases.hpp"
#include "tests/system/serve_process.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio::conformance {
namespace {

using std::chrono::milliseconds;
using test::message_of;
using test::ServeProcess;
using testing::HasSubstr;

/// A socket that takes connections, and says nothing ever.
class SilentServer {
 public:
  SilentServer() : file_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const place = reinterpret_cast<sockaddr*>(&address);
    EXPECT_EQ(bind(file_.number(), place, size), 0);
    EXPECT_EQ(listen(file_.number(), SOMAXCONN), 0);
    EXPECT_EQ(getsockname(file_.number(), place, &size), 0);
    port_ = ntohs(address.sin_port);
  }
  [[nodiscard]] std::string url() const { return "modbus://127.0.0.1:" + std::to_string(port_); }
  void close() { file_.release(); }

 private:
  test::Descriptor file_;
  int port_ = 0;
};

ExchangeResult run(ProbedLine& line, const std::string& text) {
  static const Profile profile = shipped_profile(GONIO_SOURCE_DIR, "gonio");
  return run_exchange(YamlNode::parse("{measure: exchange, " + text + "}", "mine.yaml"), line,
                      profile);
}

const std::string good = "send: \"03 {known} 0002\", expect: {reply: \"03 04 C2F6 E666\"}";

TEST(ProbedLine, CarriesRequestsOverTcpAndASerialLine) {
  const test::Program program;
  const ServeProcess server(
      program, test::quietly({test::triangle, "--ideal", "--tcp", "127.0.0.1:0", "--rtu", "pty",
                              "--baud", "115200"}));
  for (const std::string& url :
       {"modbus://" + server.tcp(), "modbus-rtu:" + server.rtu() + "?baud=115200"}) {
    const auto line = probed_line(DeviceUrl::parse(url));
    EXPECT_EQ(run(*line, good).failure, "") << url;
    EXPECT_EQ(run(*line, "send: \"41\", expect: {exception: 1}").failure, "") << url;
    EXPECT_THAT(run(*line, "send: \"41\", expect: {exception: 2}").failure, HasSubstr("C1 01"))
        << url;
  }
}

TEST(ProbedLine, SeesThatAServerClosesIt) {
  const test::Program program;
  const ServeProcess server(program,
                            test::quietly({test::triangle, "--ideal", "--tcp", "127.0.0.1:0"}));
  const auto line = probed_line(DeviceUrl::parse("modbus://" + server.tcp()));
  const std::string corrupt = "bytes: \"0001 0001 0006 01 03 012C 0001\"";
  EXPECT_EQ(run(*line, corrupt + ", expect: close").failure, "");
  EXPECT_EQ(run(*line, corrupt + ", expect: no_reply").failure, "");
  // Sending to a connection that is closed is no signal.
  EXPECT_THAT(run(*line, "steps: [{" + corrupt + ", expect: silence}, {" + good + "}]").failure,
              HasSubstr("no reply"));
}

TEST(ProbedLine, WaitsForASilentServerForABoundedTime) {
  const SilentServer server;
  const auto line = probed_line(DeviceUrl::parse(server.url()), {.reply = milliseconds(100)});
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_THAT(run(*line, good).failure, HasSubstr("no reply"));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
}

TEST(ProbedLine, LosesWhoIsNotThere) {
  SilentServer server;
  server.close();
  const auto nobody = probed_line(DeviceUrl::parse(server.url()));
  EXPECT_THROW(nobody->renew(), DeviceLost);
  EXPECT_THAT(message_of([&] { nobody->renew(); }), HasSubstr(server.url() + "/1: cannot connect"));
  const auto nowhere = probed_line(DeviceUrl::parse("modbus-rtu:/nowhere/tty"));
  EXPECT_THAT(message_of([&] { nowhere->renew(); }), HasSubstr("/nowhere/tty"));
}

}  // namespace
}  // namespace gonio::conformance
