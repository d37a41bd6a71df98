#include "tests/wire/victim.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <utility>

namespace gonio::test {

namespace {

constexpr milliseconds interval{2};
constexpr milliseconds patience_of_client{2000};

/// Sanitizers slow everything down; with them only a stall counts.
#ifdef GONIO_SANITIZED
constexpr double longest_p99_ms = 100.0;
#else
constexpr double longest_p99_ms = 5.0;
#endif

constexpr int tries = 3;
/// Of a client while nobody attacks, and the fewest that an attack has to outlast.
constexpr std::size_t quiet_requests = 50, fewest_requests = 50;

/// What a client went through before an attack and during it.
struct Trial {
  Experience quiet = {}, attacked = {};
  std::size_t files = 0;  ///< that the server had open before, without this client
};

Trial attack_once(const ServerProcess& server, const std::function<void()>& attack) {
  Victim victim(server);
  Trial trial;
  (void)becomes_true([&] { return victim.count() >= quiet_requests; });
  trial.quiet = victim.take();
  trial.files = server.open_files() - 1;
  attack();
  (void)becomes_true([&] { return victim.count() >= fewest_requests; });
  trial.attacked = victim.take();
  return trial;
}

/// Time that a thread was ready to run and did not. @param thread  as it is called in /proc.
double waited_ms(const std::string& thread) {
  std::istringstream fields(contents("/proc/" + thread + "/schedstat"));
  double ran_ns = 0.0, waited_ns = 0.0;
  fields >> ran_ns >> waited_ns;
  return waited_ns * 1e-6;
}

double p99(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[std::size_t(0.99 * double(values.size() - 1))];
}

}  // namespace

Victim::Victim(const ServerProcess& server)
    : server_(server.id()), socket_(server.port()), thread_([this] { run(); }) {}

Victim::~Victim() {
  is_ending_ = true;
  thread_.join();
}

std::size_t Victim::count() {
  const std::lock_guard lock(mutex_);
  return experience_.latencies_ms.size();
}

Experience Victim::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(experience_, {});
}

void Victim::run() {
  std::uint16_t transaction = 0;
  for (std::string complaint; complaint.empty() && !is_ending_; ++transaction) {
    const auto all_waited_ms = [&] {
      return waited_ms(std::to_string(server_)) + waited_ms("thread-self");
    };
    const double before_ms = all_waited_ms();
    const auto asked = Clock::now();
    complaint = ask(transaction);
    const std::chrono::duration<double, std::milli> latency = Clock::now() - asked;
    const double others_ms = all_waited_ms() - before_ms;
    {
      const std::lock_guard lock(mutex_);
      experience_.latencies_ms.push_back(latency.count());
      experience_.own_latencies_ms.push_back(std::max(latency.count() - others_ms, 0.0));
      experience_.complaint = complaint;
    }
    std::this_thread::sleep_until(asked + interval);
  }
}

std::string Victim::ask(std::uint16_t transaction) {
  const bool is_even = transaction % 2 == 0;
  const Bytes expected = known_reply(transaction, is_even ? 3 : 4);
  if (!socket_.send(adu(transaction, is_even ? read_known : read_known_inputs))) {
    return "the connection is gone";
  }
  const Bytes reply = socket_.receive(expected.size(), patience_of_client);
  return reply == expected ? "" : fmt::format("reply {}: '{}'", transaction, hex(reply));
}

void expect_isolation(ServerProcess& server, const std::function<void()>& attack) {
  for (int i = 1;; ++i) {
    const Trial trial = attack_once(server, attack);
    ASSERT_EQ(trial.quiet.complaint, "");
    ASSERT_EQ(trial.attacked.complaint, "");
    ASSERT_TRUE(server.is_alive()) << server.log();
    EXPECT_TRUE(becomes_true([&] { return server.open_files() == trial.files; }))
        << trial.files << " open files before, " << server.open_files() << " after";
    const std::string figures = fmt::format(
        "{:.3f} ms; without attack {:.3f} ms; without waiting for a processor {:.3f} ms",
        p99(trial.attacked.latencies_ms), p99(trial.quiet.latencies_ms),
        p99(trial.attacked.own_latencies_ms));
    testing::Test::RecordProperty("p99", figures);
    if (p99(trial.attacked.own_latencies_ms) < longest_p99_ms) {
      return;
    }
    if (i == tries) {
      FAIL() << "p99 " << figures;
    }
  }
}

}  // namespace gonio::test
