// Preloaded into the server by clock_test.cpp: each SIGUSR1 sets its wall clock, and no other
// clock, a day further on; each SIGUSR2 two days back.
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <ctime>

namespace {

constexpr long day_s = 86'400;
std::atomic<long> jump_s = 0;

void jump(int signal) { jump_s += signal == SIGUSR1 ? day_s : -2 * day_s; }

[[gnu::constructor]] void listen_to_signals() {
  struct sigaction action {};
  action.sa_handler = jump;
  action.sa_flags = SA_RESTART;
  sigaction(SIGUSR1, &action, nullptr);
  sigaction(SIGUSR2, &action, nullptr);
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming,cert-dcl37-c)
extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept {
  const long status = syscall(SYS_clock_gettime, clock, time);
  if (status == 0 && clock == CLOCK_REALTIME) {
    time->tv_sec += jump_s;
  }
  return int(status);
}
