#include "emulator/core/today.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <ctime>

namespace gonio {

namespace {

std::chrono::sys_seconds now() {
  std::time_t seconds = std::time(nullptr);
  if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH")) {
    seconds = std::strtoll(epoch, nullptr, 10);
  }
  return std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::from_time_t(seconds));
}

std::string date_of(std::chrono::sys_seconds time) {
  const std::chrono::year_month_day day{std::chrono::floor<std::chrono::days>(time)};
  return fmt::format("{:04}-{:02}-{:02}", int(day.year()), unsigned(day.month()),
                     unsigned(day.day()));
}

}  // namespace

std::string today() { return date_of(now()); }

std::string utc_now() {
  const std::chrono::sys_seconds time = now();
  const std::chrono::hh_mm_ss clock{time - std::chrono::floor<std::chrono::days>(time)};
  return fmt::format("{}T{:02}:{:02}:{:02}Z", date_of(time), clock.hours().count(),
                     clock.minutes().count(), clock.seconds().count());
}

}  // namespace gonio
