// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "transport/socket_address.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>

#include <array>
#include <cstring>

#include "trident_base/error.h"

namespace trident::bridges {
namespace {

const sockaddr_in& as_ipv4(const SocketAddress& address) {
  return reinterpret_cast<const sockaddr_in&>(address.storage);
}

const sockaddr_in6& as_ipv6(const SocketAddress& address) {
  return reinterpret_cast<const sockaddr_in6&>(address.storage);
}

}  // namespace

std::uint16_t SocketAddress::port() const {
  return ntohs(family() == AF_INET6 ? as_ipv6(*this).sin6_port : as_ipv4(*this).sin_port);
}

bool SocketAddress::is_loopback() const {
  if (family() == AF_INET) return ntohl(as_ipv4(*this).sin_addr.s_addr) >> 24 == 127;
  return family() == AF_INET6 && IN6_IS_ADDR_LOOPBACK(&as_ipv6(*this).sin6_addr);
}

std::string SocketAddress::text() const {
  std::array<char, INET6_ADDRSTRLEN> host{};
  if (family() == AF_INET6) {
    inet_ntop(AF_INET6, &as_ipv6(*this).sin6_addr, host.data(), host.size());
    return "[" + std::string(host.data()) + "]:" + std::to_string(port());
  }
  inet_ntop(AF_INET, &as_ipv4(*this).sin_addr, host.data(), host.size());
  return std::string(host.data()) + ":" + std::to_string(port());
}

bool operator==(const SocketAddress& a, const SocketAddress& b) {
  if (a.family() != b.family() || a.port() != b.port()) return false;
  if (a.family() == AF_INET6) {
    return std::memcmp(&as_ipv6(a).sin6_addr, &as_ipv6(b).sin6_addr, sizeof(in6_addr)) == 0;
  }
  return as_ipv4(a).sin_addr.s_addr == as_ipv4(b).sin_addr.s_addr;
}

SocketAddress local_address(int socket) {
  SocketAddress result;
  result.size = sizeof(result.storage);
  getsockname(socket, result.get(), &result.size);
  return result;
}

SocketAddress resolve(const std::string& url, const std::string& host, std::uint16_t port) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int code = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found);
  if (code != 0) throw Error("url '" + url + "': host '" + host + "': " + gai_strerror(code));
  SocketAddress result;
  // "localhost" may be both; a server that listens on 127.0.0.1 alone is the common case.
  const addrinfo* chosen = found;
  for (const addrinfo* entry = found; entry != nullptr; entry = entry->ai_next) {
    if (entry->ai_family == AF_INET) {
      chosen = entry;
      break;
    }
  }
  result.size = chosen->ai_addrlen;
  std::memcpy(&result.storage, chosen->ai_addr, chosen->ai_addrlen);
  freeaddrinfo(found);
  return result;
}

SocketAddress resolve_allowed(const std::string& url, const std::string& what,
                              const std::string& host, std::uint16_t port, bool allow_remote) {
  SocketAddress result = resolve(url, host, port);
  if (!result.is_loopback() && !allow_remote) {
    throw Error("url '" + url + "': " + what + " " + result.text() +
                " is not loopback; legal: 127.0.0.0/8 or ::1, unless allow_remote is true");
  }
  return result;
}

}  // namespace trident::bridges
