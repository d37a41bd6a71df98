#include "emulator/protocol/rtu_server.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <asio/buffer.hpp>
#include <asio/write.hpp>
#include <system_error>
#include <utility>

#include "emulator/protocol/trace.hpp"

namespace gonio {

namespace {

constexpr std::chrono::seconds reopen_interval{1};

asio::serial_port_base::parity parity_of(Parity parity) {
  using Option = asio::serial_port_base::parity;
  return Option(parity == Parity::even  ? Option::even
                : parity == Parity::odd ? Option::odd
                                        : Option::none);
}

}  // namespace

RtuServer::RtuServer(asio::io_context& io, Dispatcher& dispatcher, spdlog::logger& log,
                     RtuOptions options)
    : dispatcher_(dispatcher),
      log_(log),
      options_(std::move(options)),
      port_(io),
      watch_(io),
      silence_(io),
      pause_(io),
      reopen_(io),
      framer_(modbus::silence_between_frames(options_.baud)) {}

std::string RtuServer::listen() {
  open();
  receive();
  return terminal_ ? terminal_->path() : options_.path;
}

void RtuServer::stop() {
  asio::error_code ignored;
  silence_.cancel();
  pause_.cancel();
  reopen_.cancel();
  watch_.close(ignored);
  port_.close(ignored);
}

void RtuServer::open() {
  if (options_.path == "pty") {
    terminal_.reset();  // before the next one takes its link
    terminal_ = std::make_unique<PseudoTerminal>(options_.link);
    port_.assign(terminal_->duplicate_master());
    if (const int watch = terminal_->duplicate_watch(); watch >= 0) {
      watch_.assign(watch);
      watch_users();
    }
    return;
  }
  using Line = asio::serial_port_base;
  try {
    port_.open(options_.path);
    port_.set_option(Line::baud_rate(static_cast<unsigned>(options_.baud)));
    port_.set_option(Line::character_size(8));
    port_.set_option(parity_of(options_.parity));
    port_.set_option(Line::stop_bits(options_.parity == Parity::none ? Line::stop_bits::two
                                                                     : Line::stop_bits::one));
    port_.set_option(Line::flow_control(Line::flow_control::none));
  } catch (const asio::system_error& error) {
    asio::error_code ignored;
    port_.close(ignored);
    throw std::system_error(error.code(), "cannot use the serial line " + options_.path);
  }
}

void RtuServer::watch_users() {
  watch_.async_wait(asio::posix::descriptor_base::wait_read, [this](const asio::error_code& error) {
    if (!error) {
      terminal_->note_users();
      watch_users();
    }
  });
}

void RtuServer::reopen() {
  asio::error_code ignored;
  watch_.close(ignored);
  port_.close(ignored);
  reopen_.expires_after(reopen_interval);
  reopen_.async_wait([this](const asio::error_code& stopped) {
    if (stopped) {
      return;
    }
    try {
      open();
      log_.info("{}: open again", options_.path);
      receive();
    } catch (const std::system_error&) {
      reopen();
    }
  });
}

void RtuServer::receive() {
  port_.async_read_some(asio::buffer(input_),
                        [this](const asio::error_code& error, std::size_t count) {
                          if (error == asio::error::operation_aborted) {
                            return;
                          }
                          if (error) {
                            log_.warn("{}: {}", options_.path, error.message());
                            reopen();
                            return;
                          }
                          const auto now = Dispatcher::Clock::now();
                          on_silence();
                          framer_.feed(std::span(input_).first(count), now);
                          await_silence();
                          receive();
                        });
}

void RtuServer::await_silence() {
  const auto deadline = framer_.deadline();
  if (!deadline) {
    return;
  }
  silence_.expires_at(*deadline);
  silence_.async_wait([this](const asio::error_code& more_came) {
    if (!more_came) {
      on_silence();
    }
  });
}

void RtuServer::on_silence() {
  if (const auto frame = framer_.end_of_frame(Dispatcher::Clock::now())) {
    answer(*frame);
  }
  dispatcher_.counters().dropped_rtu_frames = framer_.dropped();
}

void RtuServer::answer(const modbus::RtuFrame& frame) {
  const Response response = dispatcher_.handle(modbus::Line::serial, frame.unit, frame.pdu);
  if (log_.should_log(spdlog::level::trace)) {
    log_.trace("{}: {}", options_.path, describe(frame.unit, frame.pdu, response));
  }
  if (!response.pdu) {
    return;
  }
  if (!response.fault) {
    std::vector<std::uint8_t> bytes(modbus::max_rtu_adu);
    bytes.resize(modbus::write_rtu_frame(frame.unit, response.pdu->bytes(), bytes));
    send(std::move(bytes));
    return;
  }
  Delivery delivery = faulty_rtu_reply(*response.fault, frame.unit, *response.pdu);
  send(std::move(delivery.first));
  if (!delivery.then.empty()) {
    pause_.expires_after(delivery.pause);
    pause_.async_wait(
        [this, then = std::move(delivery.then)](const asio::error_code& stopped) mutable {
          if (!stopped) {
            send(std::move(then));
          }
        });
  }
}

/// Drops the reply if nobody takes those before it: a line does not keep them.
void RtuServer::send(std::vector<std::uint8_t> bytes) {
  if (bytes.empty() || is_sending_ || (terminal_ && !terminal_->is_read())) {
    return;
  }
  is_sending_ = true;
  const auto kept = std::make_shared<std::vector<std::uint8_t>>(std::move(bytes));
  asio::async_write(port_, asio::buffer(*kept),
                    [this, kept](const asio::error_code& error, std::size_t) {
                      is_sending_ = false;
                      if (error && error != asio::error::operation_aborted) {
                        log_.warn("{}: {}", options_.path, error.message());
                      }
                    });
}

}  // namespace gonio
