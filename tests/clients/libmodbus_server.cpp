// A server on libmodbus, as the profile `plain` of standards/modbus describes it, for the
// conformance suite to judge. Prints where it listens, and serves until it is ended.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstdio>

#include "tests/benchmarks/libmodbus_select_server.hpp"

int main() {
  const int listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  if (bind(listener, reinterpret_cast<sockaddr*>(&address), size) != 0 ||
      listen(listener, SOMAXCONN) != 0 ||
      getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    std::perror("listen");
    return 1;
  }
  std::printf("{\"tcp\": \"127.0.0.1:%d\"}\n", int{ntohs(address.sin_port)});
  std::fflush(stdout);
  constexpr int values = 4096;
  gonio::bench::serve_with_libmodbus(listener, modbus_mapping_new(values, values, values, values));
}
