#include "emulator/protocol/server.hpp"

#include <sched.h>
#include <spdlog/spdlog.h>

#include <asio/io_context.hpp>
#include <asio/post.hpp>
#include <asio/signal_set.hpp>
#include <asio/steady_timer.hpp>
#include <csignal>

#include "emulator/protocol/rtu_server.hpp"
#include "emulator/protocol/tcp_server.hpp"

namespace gonio {

namespace {

/// How often time passes for the units when nobody asks.
constexpr std::chrono::seconds tick_interval{1};

/// How long the loop stays awake after an event.
constexpr std::chrono::microseconds wakeful{50};

/// How often ready connections are served before the rest has its turn.
constexpr int rounds_of_connections = 16;

}  // namespace

struct Server::Loop {
  Loop(Dispatcher& a_dispatcher, spdlog::logger& a_log)
      : dispatcher(a_dispatcher), log(a_log), signals(io, SIGTERM, SIGINT), tick_timer(io) {
    signals.async_wait([this](const asio::error_code& error, int number) {
      if (!error) {
        log.info("signal {}: ending", number);
        end();
      }
    });
    tick();
  }

  void tick() {
    dispatcher.catch_up();
    tick_timer.expires_after(tick_interval);
    tick_timer.async_wait([this](const asio::error_code& stopped) {
      if (!stopped) {
        tick();
      }
    });
  }

  void end() {
    signals.cancel();
    tick_timer.cancel();
    if (tcp) {
      tcp->stop();
    }
    if (rtu) {
      rtu->stop();
    }
    // What has happened already but waits its turn - a connection, the end of an interval - would
    // begin anew.
    io.stop();
  }

  Dispatcher& dispatcher;
  spdlog::logger& log;
  asio::io_context io{1};  // one thread
  asio::signal_set signals;
  asio::steady_timer tick_timer;
  std::unique_ptr<TcpServer> tcp;
  std::unique_ptr<RtuServer> rtu;
};

Server::Server(Dispatcher& dispatcher, spdlog::logger& log)
    : loop_(std::make_unique<Loop>(dispatcher, log)) {}

Server::~Server() = default;

Listening Server::listen(const std::optional<TcpOptions>& tcp,
                         const std::optional<RtuOptions>& rtu) {
  Listening listening;
  if (tcp) {
    loop_->tcp = std::make_unique<TcpServer>(loop_->io, loop_->dispatcher, loop_->log, *tcp);
    listening.tcp = loop_->tcp->listen();
    loop_->log.info("Modbus TCP on {}", *listening.tcp);
  }
  if (rtu) {
    loop_->rtu = std::make_unique<RtuServer>(loop_->io, loop_->dispatcher, loop_->log, *rtu);
    listening.rtu = loop_->rtu->listen();
    loop_->log.info("Modbus RTU on {}", *listening.rtu);
  }
  return listening;
}

/// While requests come in quick succession the loop looks for the next one instead of sleeping: to
/// be woken costs several times what an answer does. Connections are looked at more often than
/// timers, signals, the serial line and new connections.
void Server::run() {
  asio::io_context& io = loop_->io;
  TcpServer* const tcp = loop_->tcp.get();
  auto last_event = Dispatcher::Clock::now();
  int rounds = 0;
  while (!io.stopped()) {
    const bool has_served = tcp != nullptr && tcp->poll() > 0;
    const bool is_turn = !has_served || ++rounds % rounds_of_connections == 0;
    const bool has_more = is_turn && io.poll_one() > 0;
    if (has_served || has_more) {
      last_event = Dispatcher::Clock::now();
    } else if (Dispatcher::Clock::now() - last_event < wakeful) {
      sched_yield();
    } else {
      if (tcp != nullptr) {
        tcp->wake_when_ready();
      }
      io.run_one();
      last_event = Dispatcher::Clock::now();
    }
  }
}

void Server::stop() {
  asio::post(loop_->io, [this] { loop_->end(); });
}

}  // namespace gonio
