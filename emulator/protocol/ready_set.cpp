#include "emulator/protocol/ready_set.hpp"

#include <sys/epoll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace gonio {

namespace {

constexpr std::size_t batch = 64;

std::uint32_t events_of(ReadySet::Interest interest) {
  switch (interest) {
    case ReadySet::Interest::input:
      return EPOLLIN;
    case ReadySet::Interest::output:
      return EPOLLOUT;
    case ReadySet::Interest::none:
      break;
  }
  return 0;
}

}  // namespace

ReadySet::ReadySet() : epoll_(epoll_create1(EPOLL_CLOEXEC)) {
  if (epoll_ < 0) {
    throw std::system_error(errno, std::generic_category(), "cannot wait for sockets");
  }
}

ReadySet::~ReadySet() { close(epoll_); }

void ReadySet::add(int socket, Watcher& watcher, Interest interest) {
  control(EPOLL_CTL_ADD, socket, watcher, interest);
}

void ReadySet::change(int socket, Watcher& watcher, Interest interest) {
  control(EPOLL_CTL_MOD, socket, watcher, interest);
}

void ReadySet::remove(int socket) { epoll_ctl(epoll_, EPOLL_CTL_DEL, socket, nullptr); }

void ReadySet::control(int operation, int socket, Watcher& watcher, Interest interest) {
  epoll_event event{};
  event.events = events_of(interest);
  event.data.ptr = &watcher;
  if (epoll_ctl(epoll_, operation, socket, &event) != 0) {
    throw std::system_error(errno, std::generic_category(), "cannot wait for a socket");
  }
}

int ReadySet::poll() {
  std::array<epoll_event, batch> events;  // written by the kernel
  const int count = epoll_wait(epoll_, events.data(), int(events.size()), 0);
  for (int j = 0; j < count; ++j) {
    static_cast<Watcher*>(events[std::size_t(j)].data.ptr)->on_ready();
  }
  return count > 0 ? count : 0;
}

}  // namespace gonio
