#include "emulator/protocol/tcp_server.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include <algorithm>
#include <system_error>
#include <utility>
#include <vector>

namespace gonio {

using asio::ip::tcp;

namespace {

constexpr std::chrono::milliseconds sweep_interval{100};
constexpr std::chrono::milliseconds retry_interval{50};
constexpr std::chrono::seconds idle_enough{1};

std::string name_of(const tcp::endpoint& endpoint) {
  const bool is_v6 = endpoint.address().is_v6();
  return fmt::format("{}{}{}:{}", is_v6 ? "[" : "", endpoint.address().to_string(),
                     is_v6 ? "]" : "", endpoint.port());
}

/// Lets the process have as many descriptors as that takes, or as many as it may have.
void raise_descriptor_limit(std::size_t connections) {
  constexpr rlim_t others = 64;
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur < connections + others) {
    limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, connections + others);
    setrlimit(RLIMIT_NOFILE, &limit);
  }
}

}  // namespace

TcpServer::TcpServer(asio::io_context& io, Dispatcher& dispatcher, spdlog::logger& log,
                     TcpOptions options)
    : any_ready_(io, ready_.descriptor()),
      options_(std::move(options)),
      allowed_(options_.allow),
      surroundings_{.io = io,
                    .ready = ready_,
                    .dispatcher = dispatcher,
                    .options = options_,
                    .log = log,
                    .on_close =
                        [this](const TcpConnection& connection) {
                          connections_.erase(&connection);
                          --surroundings_.dispatcher.counters().open_connections;
                        }},
      acceptor_(io),
      sweep_timer_(io),
      retry_timer_(io) {}

TcpServer::~TcpServer() {
  any_ready_.release();  // not its own
}

std::string TcpServer::listen() {
  const std::string place = fmt::format("{}:{}", options_.host, options_.port);
  try {
    tcp::resolver resolver(acceptor_.get_executor());
    const tcp::endpoint endpoint =
        *resolver.resolve(options_.host, std::to_string(options_.port), tcp::resolver::passive)
             .begin();
    acceptor_.open(endpoint.protocol());
    acceptor_.set_option(tcp::acceptor::reuse_address(true));
    acceptor_.bind(endpoint);
    acceptor_.listen();
  } catch (const asio::system_error& error) {
    throw std::system_error(error.code(), "cannot listen on " + place);
  }
  raise_descriptor_limit(options_.max_connections);
  accept();
  sweep();
  return name_of(acceptor_.local_endpoint());
}

void TcpServer::wake_when_ready() {
  if (is_armed_ || !acceptor_.is_open()) {
    return;
  }
  is_armed_ = true;
  any_ready_.async_wait(asio::posix::descriptor_base::wait_read,
                        [this](const asio::error_code& error) {
                          is_armed_ = false;
                          if (!error) {
                            static_cast<void>(poll());
                          }
                        });
}

void TcpServer::stop() {
  any_ready_.cancel();
  asio::error_code ignored;
  acceptor_.close(ignored);
  sweep_timer_.cancel();
  retry_timer_.cancel();
  while (!connections_.empty()) {
    const auto connection = connections_.begin()->second;
    connection->close("the server ends");
  }
}

void TcpServer::accept() {
  acceptor_.async_accept([this](const asio::error_code& error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) {
      return;
    }
    if (error == asio::error::no_descriptors || error.value() == ENFILE ||
        error == asio::error::no_buffer_space || error == asio::error::no_memory) {
      // Asking again at once would spin: the connection still waits.
      if (!is_short_) {
        surroundings_.log.warn("cannot accept connections for now: {}", error.message());
      }
      is_short_ = true;
      static_cast<void>(make_room());
      retry_timer_.expires_after(retry_interval);
      retry_timer_.async_wait([this](const asio::error_code& stopped) {
        if (!stopped) {
          accept();
        }
      });
      return;
    }
    if (!error) {
      is_short_ = false;
      admit(std::move(socket));
    }
    accept();
  });
}

void TcpServer::admit(tcp::socket socket) {
  Counters& counters = surroundings_.dispatcher.counters();
  asio::error_code error;
  const tcp::endpoint peer = socket.remote_endpoint(error);
  if (error) {
    return;  // gone already
  }
  if (!allowed_.contains(peer.address())) {
    ++counters.refused_connections;
    surroundings_.log.warn("{}: refused, not an allowed address", name_of(peer));
    return;
  }
  if (connections_.size() >= options_.max_connections && !make_room()) {
    ++counters.refused_connections;
    surroundings_.log.debug("{}: refused, all connections are at work", name_of(peer));
    return;
  }
  ++counters.connections;
  ++counters.open_connections;
  const auto connection =
      std::make_shared<TcpConnection>(socket.release(), surroundings_, name_of(peer));
  connections_.emplace(connection.get(), connection);
  try {
    connection->start();
  } catch (const std::system_error& failure) {  // the kernel is short of memory, say
    connection->close(failure.what());
  }
}

/// Closes the connection that will be missed least. @return  false if all are at work.
bool TcpServer::make_room() {
  const auto now = TcpConnection::Clock::now();
  std::shared_ptr<TcpConnection> victim;
  for (const auto& [key, connection] : connections_) {
    const auto rank = [](const TcpConnection& c) {
      return std::make_pair(c.was_used(), c.last_activity());
    };
    if (!victim || rank(*connection) < rank(*victim)) {
      victim = connection;
    }
  }
  if (!victim || (victim->was_used() && now - victim->last_activity() < idle_enough)) {
    return false;
  }
  victim->close("to make room");
  return true;
}

void TcpServer::sweep() {
  const auto now = TcpConnection::Clock::now();
  std::vector<std::shared_ptr<TcpConnection>> all;
  all.reserve(connections_.size());
  for (const auto& [key, connection] : connections_) {
    all.push_back(connection);
  }
  for (const auto& connection : all) {
    connection->close_if_overdue(now);
  }
  sweep_timer_.expires_after(sweep_interval);
  sweep_timer_.async_wait([this](const asio::error_code& stopped) {
    if (!stopped) {
      sweep();
    }
  });
}

}  // namespace gonio
