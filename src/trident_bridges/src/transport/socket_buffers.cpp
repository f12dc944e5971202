// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "transport/socket_buffers.h"

#include <sys/socket.h>

namespace trident::bridges {
namespace {

std::string set_buffer(int socket, int option, int forced_option, const char* name,
                       const char* limit, std::uint32_t bytes) {
  const int asked = static_cast<int>(bytes);
  // Beyond the system's limit with CAP_NET_ADMIN alone.
  if (setsockopt(socket, SOL_SOCKET, forced_option, &asked, sizeof(asked)) != 0) {
    setsockopt(socket, SOL_SOCKET, option, &asked, sizeof(asked));
  }
  int given = 0;
  socklen_t size = sizeof(given);
  getsockopt(socket, SOL_SOCKET, option, &given, &size);
  given /= 2;  // the kernel doubles it for its bookkeeping
  std::string text = std::string(name) + " buffer " + std::to_string(given) + " bytes";
  if (given < asked) text += " of " + std::to_string(asked) + " (" + limit + ")";
  return text;
}

}  // namespace

std::string set_socket_buffers(int socket, std::uint32_t receive_bytes, std::uint32_t send_bytes) {
  return set_buffer(socket, SO_RCVBUF, SO_RCVBUFFORCE, "receive", "net.core.rmem_max",
                    receive_bytes) +
         ", " +
         set_buffer(socket, SO_SNDBUF, SO_SNDBUFFORCE, "send", "net.core.wmem_max", send_bytes);
}

}  // namespace trident::bridges
