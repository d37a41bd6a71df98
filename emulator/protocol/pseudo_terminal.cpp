#include "emulator/protocol/pseudo_terminal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <pty.h>
#include <sys/inotify.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace gonio {

namespace {

std::system_error failure(const std::string& what) {
  return {errno, std::generic_category(), what};
}

void make_link(const std::filesystem::path& link, const std::string& path) {
  if (std::filesystem::is_symlink(std::filesystem::symlink_status(link))) {
    std::filesystem::remove(link);  // of a run that was killed
  }
  std::error_code error;
  std::filesystem::create_symlink(path, link, error);
  if (error) {
    throw std::system_error(error, fmt::format("cannot make the link {}", link.string()));
  }
}

}  // namespace

PseudoTerminal::PseudoTerminal(const std::optional<std::string>& link) {
  termios raw{};
  cfmakeraw(&raw);
  if (openpty(&master_.number, &device_.number, nullptr, &raw, nullptr) != 0) {
    throw failure("cannot make a pseudo terminal");
  }
  for (const int descriptor : {master_.number, device_.number}) {
    fcntl(descriptor, F_SETFD, FD_CLOEXEC);
  }
  // The device stays open here: else the master fails when its last user leaves.
  std::array<char, 256> name{};
  if (ttyname_r(device_.number, name.data(), name.size()) != 0) {
    throw failure("cannot name the pseudo terminal");
  }
  path_ = name.data();
  watch_.number = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  inotify_add_watch(watch_.number, path_.c_str(), IN_OPEN | IN_CLOSE);
  if (link) {
    make_link(*link, path_);
    link_ = *link;
  }
}

PseudoTerminal::~PseudoTerminal() {
  if (link_) {
    std::error_code ignored;
    if (std::filesystem::read_symlink(*link_, ignored) == path_) {  // else it is another's by now
      std::filesystem::remove(*link_, ignored);
    }
  }
}

PseudoTerminal::Descriptor::~Descriptor() {
  if (number >= 0) {
    close(number);
  }
}

int PseudoTerminal::Descriptor::duplicate() const { return fcntl(number, F_DUPFD_CLOEXEC, 0); }

int PseudoTerminal::duplicate_master() const {
  const int copy = master_.duplicate();
  if (copy < 0) {
    throw failure("cannot use the pseudo terminal");
  }
  return copy;
}

int PseudoTerminal::duplicate_watch() const { return watch_.duplicate(); }

void PseudoTerminal::note_users() const {
  std::array<char, 4096> events{};
  while (read(watch_.number, events.data(), events.size()) > 0) {
  }
  tcflush(device_.number, TCIFLUSH);
}

bool PseudoTerminal::is_read() const {
  constexpr int most_unread = 4 * 256;  // four replies; a flush reaches a few times that
  int unread = 0;
  return ioctl(device_.number, FIONREAD, &unread) != 0 || unread <= most_unread;
}

}  // namespace gonio
