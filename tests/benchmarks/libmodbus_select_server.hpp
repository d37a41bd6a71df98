#pragma once

#include <modbus/modbus.h>
#include <sys/select.h>
#include <unistd.h>

#include <array>
#include <cstdint>

namespace gonio::bench {

/// The server that libmodbus offers for many clients: one thread and select(), as in its
/// tests/bandwidth-server-many-up.c. Never returns.
/// @param listener  a listening socket.
/// @param map       what it serves.
[[noreturn]] inline void serve_with_libmodbus(int listener, modbus_mapping_t* map) {
  modbus_t* const context = modbus_new_tcp("127.0.0.1", 0);
  fd_set all;
  FD_ZERO(&all);
  FD_SET(listener, &all);
  int highest = listener;
  for (;;) {
    fd_set ready = all;
    if (select(highest + 1, &ready, nullptr, nullptr, nullptr) < 0) {
      _exit(1);
    }
    for (int socket = 0; socket <= highest; ++socket) {
      if (!FD_ISSET(socket, &ready)) {
        continue;
      }
      if (socket == listener) {
        const int accepted = accept(listener, nullptr, nullptr);
        FD_SET(accepted, &all);
        highest = accepted > highest ? accepted : highest;
        continue;
      }
      modbus_set_socket(context, socket);
      std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> query{};
      const int size = modbus_receive(context, query.data());
      if (size > 0) {
        modbus_reply(context, query.data(), size, map);
      } else if (size < 0) {
        close(socket);
        FD_CLR(socket, &all);
      }
    }
  }
}

}  // namespace gonio::bench
