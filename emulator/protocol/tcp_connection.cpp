#include "emulator/protocol/tcp_connection.hpp"

#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "emulator/protocol/trace.hpp"

namespace gonio {

namespace {

/// Failure is harmless: a peer that is gone already shows at the first read.
void set_options(int socket) {
  const int on = 1;
  fcntl(socket, F_SETFL, fcntl(socket, F_GETFL) | O_NONBLOCK);
  setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  setsockopt(socket, SOL_SOCKET, SO_KEEPALIVE, &on, sizeof on);
}

bool would_block() { return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR; }

}  // namespace

TcpConnection::TcpConnection(int socket, Surroundings& surroundings, std::string peer)
    : socket_(socket),
      surroundings_(surroundings),
      pause_(surroundings.io),
      peer_(std::move(peer)) {
  set_options(socket_);
}

TcpConnection::~TcpConnection() { release(); }

void TcpConnection::start() {
  surroundings_.ready.add(socket_, *this, interest_);
  surroundings_.log.debug("{}: connected", peer_);
}

void TcpConnection::release() {
  if (socket_ >= 0) {
    surroundings_.ready.remove(socket_);
    ::close(socket_);
    socket_ = -1;
  }
}

void TcpConnection::close(const char* reason) {
  if (socket_ < 0) {
    return;
  }
  surroundings_.log.debug("{}: closed, {}", peer_, reason);
  release();
  pause_.cancel();
  surroundings_.on_close(*this);
}

void TcpConnection::close_if_overdue(Clock::time_point now) {
  if (is_paused_) {
    return;
  }
  const bool is_stuck = sent_ < output_.size();
  if (framer_.is_partial() && !is_stuck &&
      now - frame_began_ > surroundings_.options.stall_timeout) {
    close("a request that never ended");
  } else if (is_stuck && now - last_activity_ > surroundings_.options.stall_timeout) {
    close("it does not take its replies");
  } else if (now - last_activity_ > surroundings_.options.idle_timeout) {
    close("idle");
  }
}

void TcpConnection::on_ready() {
  const auto keep = shared_from_this();
  switch (interest_) {
    case ReadySet::Interest::input:
      receive();
      break;
    case ReadySet::Interest::output:
      last_activity_ = Clock::now();
      proceed();
      break;
    case ReadySet::Interest::none:  // only the end is told unasked
      close("the peer is gone");
      break;
  }
}

/// Does all that can be done now, and waits for what comes next.
void TcpConnection::proceed() {
  while (answer_some()) {
    if (!send()) {
      return;
    }
    if (sent_ < output_.size()) {
      wait_for(ReadySet::Interest::output);
      return;
    }
  }
  if (is_paused_) {
    wait_for(ReadySet::Interest::none);
  } else if (framer_.is_corrupt()) {
    ++surroundings_.dispatcher.counters().corrupt_headers;
    close("corrupt header");
  } else if (is_cut_ || is_ending_) {
    close(is_cut_ ? "on demand" : "end of the stream");
  } else {
    wait_for(ReadySet::Interest::input);
  }
}

/// Answers what is there, as far as its replies may queue. @return  whether there is output.
bool TcpConnection::answer_some() {
  while (!is_paused_ && !is_cut_ && output_.size() < surroundings_.options.max_queue) {
    const auto frame = framer_.next();
    if (!frame) {
      break;
    }
    was_used_ = true;
    frame_began_ = last_activity_;
    answer(*frame);
  }
  return !output_.empty();
}

void TcpConnection::receive() {
  const auto space = framer_.space();
  const ssize_t count = recv(socket_, space.data(), space.size(), 0);
  if (count < 0) {
    if (!would_block()) {
      close(std::strerror(errno));
    }
    return;
  }
  is_ending_ = count == 0;  // half closed: what was asked is still answered
  last_activity_ = Clock::now();
  if (!framer_.is_partial()) {
    frame_began_ = last_activity_;
  }
  framer_.received(std::size_t(count));
  proceed();
}

void TcpConnection::answer(const modbus::TcpFrame& frame) {
  const Response response =
      surroundings_.dispatcher.handle(modbus::Line::tcp, frame.unit, frame.pdu);
  if (surroundings_.log.should_log(spdlog::level::trace)) {
    surroundings_.log.trace("{}: {}", peer_, describe(frame.unit, frame.pdu, response));
  }
  if (!response.pdu) {
    return;
  }
  if (response.fault) {
    schedule(faulty_tcp_reply(*response.fault, frame.transaction, frame.unit, *response.pdu));
    return;
  }
  const std::size_t end = output_.size();
  output_.resize(end + modbus::max_tcp_adu);
  output_.resize(end + modbus::write_tcp_frame(frame.transaction, frame.unit, response.pdu->bytes(),
                                               std::span(output_).subspan(end)));
}

void TcpConnection::schedule(Delivery delivery) {
  output_.insert(output_.end(), delivery.first.begin(), delivery.first.end());
  is_cut_ = is_cut_ || delivery.close;
  if (delivery.then.empty()) {
    return;
  }
  is_paused_ = true;
  pause_.expires_after(delivery.pause);
  pause_.async_wait(
      [self = shared_from_this(), then = std::move(delivery.then)](const asio::error_code& error) {
        if (!error && self->socket_ >= 0) {
          self->is_paused_ = false;
          self->last_activity_ = Clock::now();
          const bool waits_for_output = !self->output_.empty();
          self->output_.insert(self->output_.end(), then.begin(), then.end());
          if (!waits_for_output) {
            self->proceed();
          }
        }
      });
}

/// Sends what the kernel takes. @return  false if the connection is gone.
bool TcpConnection::send() {
  while (sent_ < output_.size()) {
    const ssize_t count =
        ::send(socket_, output_.data() + sent_, output_.size() - sent_, MSG_NOSIGNAL);
    if (count < 0 && would_block()) {
      return true;
    }
    if (count < 0) {
      close(std::strerror(errno));
      return false;
    }
    sent_ += std::size_t(count);
  }
  output_.clear();
  sent_ = 0;
  return true;
}

void TcpConnection::wait_for(ReadySet::Interest interest) {
  if (interest != interest_) {
    interest_ = interest;
    surroundings_.ready.change(socket_, *this, interest);
  }
}

}  // namespace gonio
