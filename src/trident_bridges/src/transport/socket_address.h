// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/socket.h>

#include <cstdint>
#include <string>

namespace trident::bridges {

/// An address of IPv4 or IPv6 with a port.
struct SocketAddress {
  sockaddr_storage storage{};  ///< as the system's calls take it
  socklen_t size = 0;          ///< of what is used in `storage`; 0: no address

  /// For the system's calls.
  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }
  /// For calls that fill it in; `size` must be set to the size of `storage` before.
  sockaddr* get() { return reinterpret_cast<sockaddr*>(&storage); }
  /// AF_INET or AF_INET6.
  int family() const { return storage.ss_family; }
  /// In the machine's byte order.
  std::uint16_t port() const;
  /// True for 127.0.0.0/8 and ::1.
  bool is_loopback() const;
  /// "127.0.0.1:14550", "[::1]:14550".
  std::string text() const;
  /// Of family, host and port.
  friend bool operator==(const SocketAddress& a, const SocketAddress& b);
};

/// The address of a socket itself.
SocketAddress local_address(int socket);

/// The first address of a host's name or number. `url` stands at the beginning of an error. Throws
/// Error when the name is unknown.
SocketAddress resolve(const std::string& url, const std::string& host, std::uint16_t port);

/// The same, and throws Error unless it is loopback or `allow_remote`; `what`: "bind", "host".
SocketAddress resolve_allowed(const std::string& url, const std::string& what,
                              const std::string& host, std::uint16_t port, bool allow_remote);

}  // namespace trident::bridges
