#include "tests/conformance/probed_line.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <map>
#include <utility>

#include "emulator/protocol/rtu_framer.hpp"
#include "emulator/protocol/wire_number.hpp"
#include "tests/conformance/device_port.hpp"

namespace gonio::conformance {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// A file descriptor that is read and written without blocking for longer than one is told.
class Stream {
 public:
  enum class State { open, closed };

  Stream() = default;
  ~Stream() { close(); }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;

  [[nodiscard]] int file() const { return file_; }
  void reset(int file) {
    close();
    file_ = file;
  }
  void close() {
    if (file_ >= 0) {
      ::close(std::exchange(file_, -1));
    }
  }

  /// @return  whether it is ready, or has failed, before the deadline.
  [[nodiscard]] bool waits_for(short events, Clock::time_point deadline) const {
    const auto left = std::chrono::ceil<milliseconds>(deadline - Clock::now()).count();
    pollfd entry{file_, events, 0};
    return poll(&entry, 1, static_cast<int>(std::max<long>(left, 0))) > 0;
  }
  /// What does not go before the deadline is left: the answer will show it.
  void write(std::span<const std::uint8_t> bytes, Clock::time_point deadline) const {
    while (!bytes.empty() && waits_for(POLLOUT, deadline)) {
      const ssize_t count = write_some(bytes);
      if (count < 0 && errno != EAGAIN && errno != EINTR) {
        return;
      }
      bytes = bytes.subspan(std::size_t(std::max<ssize_t>(count, 0)));
    }
  }
  /// Reads up to `count` bytes. @return  `closed` if the other side has closed it.
  State read(std::size_t count, Clock::time_point deadline, Bytes& out) const {
    std::array<std::uint8_t, 512> part{};
    while (count > 0 && waits_for(POLLIN, deadline)) {
      const ssize_t more = ::read(file_, part.data(), std::min(count, part.size()));
      if (more == 0 || (more < 0 && errno != EAGAIN && errno != EINTR)) {
        return State::closed;
      }
      const auto size = std::size_t(std::max<ssize_t>(more, 0));
      out.insert(out.end(), part.begin(), part.begin() + std::ptrdiff_t(size));
      count -= size;
    }
    return State::open;
  }

 private:
  /// The other side may be gone, which is no signal for us.
  [[nodiscard]] ssize_t write_some(std::span<const std::uint8_t> bytes) const {
    const ssize_t count = ::send(file_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    return count < 0 && errno == ENOTSOCK ? ::write(file_, bytes.data(), bytes.size()) : count;
  }

  int file_ = -1;
};

[[noreturn]] void lose(const DeviceUrl& url, const std::string& what, const char* why) {
  throw DeviceLost(fmt::format("{}: {}: {}", url.text(), what, why));
}

class TcpLine final : public ProbedLine {
 public:
  TcpLine(DeviceUrl url, LinePatience patience) : url_(std::move(url)), patience_(patience) {}

  [[nodiscard]] modbus::Line kind() const override { return modbus::Line::tcp; }
  void renew() override {
    addrinfo hints{};
    hints.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    const std::string port = std::to_string(url_.port);
    if (const int error = getaddrinfo(url_.host.c_str(), port.c_str(), &hints, &found);
        error != 0) {
      lose(url_, "cannot connect", gai_strerror(error));
    }
    const std::unique_ptr<addrinfo, void (*)(addrinfo*)> addresses(found, freeaddrinfo);
    int error = 0;
    for (const addrinfo* address = found; address != nullptr; address = address->ai_next) {
      error = connect(*address);
      if (error == 0) {
        return;
      }
    }
    lose(url_, "cannot connect", std::strerror(error));
  }
  void send(std::span<const std::uint8_t> bytes, milliseconds /*silence*/) override {
    stream_.write(bytes, Clock::now() + patience_.reply);
  }
  Bytes receive() override { return receive(patience_.reply); }
  Bytes receive_more() override { return receive(patience_.more); }
  bool is_closed() override {
    Bytes dropped;
    constexpr std::size_t all = 1U << 20U;
    return stream_.read(all, Clock::now() + patience_.reply, dropped) == Stream::State::closed;
  }

 private:
  /// @return  0, or why not, as errno.
  int connect(const addrinfo& address) {
    stream_.reset(socket(address.ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    if (stream_.file() < 0) {
      return errno;
    }
    const int on = 1;
    setsockopt(stream_.file(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    if (::connect(stream_.file(), address.ai_addr, address.ai_addrlen) == 0) {
      return 0;
    }
    if (errno != EINPROGRESS) {
      return errno;
    }
    if (!stream_.waits_for(POLLOUT, Clock::now() + patience_.reply)) {
      return ETIMEDOUT;
    }
    int error = 0;
    socklen_t size = sizeof error;
    getsockopt(stream_.file(), SOL_SOCKET, SO_ERROR, &error, &size);
    return error;
  }

  /// One whole ADU by the length in its header, or what there is of it.
  [[nodiscard]] Bytes receive(milliseconds within) const {
    constexpr std::size_t before_unit = 6;
    Bytes bytes;
    (void)stream_.read(before_unit, Clock::now() + within, bytes);
    if (bytes.size() == before_unit) {
      // What has begun is not cut off by a short wait for nothing.
      (void)stream_.read(modbus::u16_at(bytes, before_unit - 2), Clock::now() + patience_.reply,
                         bytes);
    }
    return bytes;
  }

  DeviceUrl url_;
  LinePatience patience_;
  Stream stream_;
};

class SerialLine final : public ProbedLine {
 public:
  SerialLine(DeviceUrl url, LinePatience patience) : url_(std::move(url)), patience_(patience) {}

  [[nodiscard]] modbus::Line kind() const override { return modbus::Line::serial; }
  void renew() override {
    if (stream_.file() < 0) {
      open();
    }
    (void)receive(patience_.more);
  }
  void send(std::span<const std::uint8_t> bytes, milliseconds silence_before) override {
    const auto frame_end =
        std::chrono::ceil<milliseconds>(modbus::silence_between_frames(url_.baud));
    poll(nullptr, 0, static_cast<int>(std::max(silence_before, frame_end).count()));
    under_way_ = time_of(bytes.size());
    stream_.write(bytes, Clock::now() + patience_.reply + under_way_);
    has_replied_ = false;
  }
  Bytes receive() override {
    has_replied_ = true;
    return receive(patience_.reply);
  }
  /// After a reply the silence behind it has been waited for.
  Bytes receive_more() override { return has_replied_ ? Bytes() : receive(patience_.more); }
  bool is_closed() override { return false; }

 private:
  void open() {
    stream_.reset(::open(url_.path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    termios line{};
    if (stream_.file() < 0 || tcgetattr(stream_.file(), &line) != 0) {
      lose(url_, "cannot open", std::strerror(errno));
    }
    static const std::map<int, speed_t> speeds{
        {1200, B1200},   {2400, B2400},   {4800, B4800},     {9600, B9600},    {19200, B19200},
        {38400, B38400}, {57600, B57600}, {115200, B115200}, {230400, B230400}};
    const auto speed = speeds.find(url_.baud);
    if (speed == speeds.end()) {
      lose(url_, "cannot open", "no such speed");
    }
    cfmakeraw(&line);
    cfsetspeed(&line, speed->second);
    line.c_cflag |= CLOCAL | CREAD;
    line.c_cflag |= url_.parity == 'N' ? CSTOPB : url_.parity == 'O' ? PARENB | PARODD : PARENB;
    if (tcsetattr(stream_.file(), TCSANOW, &line) != 0) {
      lose(url_, "cannot open", std::strerror(errno));
    }
  }

  [[nodiscard]] milliseconds time_of(std::size_t characters) const {
    constexpr int bits_of_a_character = 11;
    return milliseconds(1000 * bits_of_a_character * long(characters) / url_.baud);
  }

  /// All until nothing comes for a while. A reply with a wrong CRC is shown without its two last
  /// bytes, so that none matches it.
  [[nodiscard]] Bytes receive(milliseconds within) const {
    constexpr milliseconds silence{30};
    constexpr std::size_t crc_size = 2;
    constexpr std::size_t enough = 2 * modbus::max_rtu_adu;  // a line may babble for ever
    Bytes bytes;
    std::size_t before = 0;
    do {
      before = bytes.size();
      const milliseconds wait = before == 0 ? within + under_way_ : silence;
      (void)stream_.read(1, Clock::now() + wait, bytes);
    } while (bytes.size() > before && bytes.size() < enough);
    if (bytes.size() > crc_size && modbus::crc16(bytes) != 0) {
      bytes.resize(bytes.size() - crc_size);
    }
    return bytes;
  }

  DeviceUrl url_;
  LinePatience patience_;
  Stream stream_;
  milliseconds under_way_{};  // what was sent last, on the line
  bool has_replied_ = false;
};

}  // namespace

std::unique_ptr<ProbedLine> probed_line(const DeviceUrl& url, const LinePatience& patience) {
  if (url.is_rtu) {
    return std::make_unique<SerialLine>(url, patience);
  }
  return std::make_unique<TcpLine>(url, patience);
}

}  // namespace gonio::conformance
