// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "transport/socket_buffers.h"
#include "transport/tcp_endpoint.h"
#include "trident_base/error.h"

namespace trident::bridges {
namespace {

constexpr int kBacklog = 1024;
constexpr int kAcceptedPerTurn = 64;
constexpr double kPause_s = 0.1;

/// Of descriptors or memory, which may end.
bool is_shortage(int error) {
  return error == EMFILE || error == ENFILE || error == ENOBUFS || error == ENOMEM;
}

}  // namespace

TcpServer::TcpServer(const EndpointOptions& options, const EndpointUrl& url, PollLoop& loop,
                     EndpointEvents events)
    : TcpEndpoint(options, loop, std::move(events)), resumption_(loop) {
  open(url);
  loop_.watch(listener_.get(), PollLoop::kReadable, [this](std::uint32_t) { accept_some(); });
}

TcpServer::~TcpServer() { loop_.forget(listener_.get()); }

void TcpServer::open(const EndpointUrl& url) {
  const SocketAddress address =
      resolve_allowed(options_.url, "bind", url.bind_host.empty() ? "127.0.0.1" : url.bind_host,
                      url.bind_port.value_or(options_.default_bind_port), options_.allow_remote);
  listener_ = Descriptor(socket(address.family(), SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const int on = 1;
  setsockopt(listener_.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
  // Accepted sockets inherit these; a slow peer is not to have more in the kernel than in its
  // queue.
  const std::string buffers =
      set_socket_buffers(listener_.get(), options_.socket_buffer,
                         std::min(options_.socket_buffer, options_.queue_bytes));
  if (!listener_.is_open() || bind(listener_.get(), address.get(), address.size) != 0 ||
      listen(listener_.get(), kBacklog) != 0) {
    throw Error("url '" + options_.url + "': bind " + address.text() + ": " + std::strerror(errno));
  }
  const SocketAddress bound = local_address(listener_.get());
  port_ = bound.port();
  name_ = "tcp-l " + bound.text();
  std::string text = buffers + "; up to " + std::to_string(options_.max_peers) + " connections";
  if (!bound.is_loopback()) text += "; other machines can reach it (allow_remote)";
  report_notice(text);
}

void TcpServer::accept_some() {
  for (int i = 0; i < kAcceptedPerTurn; ++i) {
    SocketAddress address;
    address.size = sizeof(address.storage);
    Descriptor socket(
        accept4(listener_.get(), address.get(), &address.size, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (socket.is_open()) {
      admit(std::move(socket), address);
    } else if (is_shortage(errno)) {
      pause();
      return;
    } else if (errno == EAGAIN) {
      return;
    }
  }
}

void TcpServer::admit(Descriptor socket, const SocketAddress& address) {
  if (connection_count() < options_.max_peers) {
    add(std::move(socket), address.text());
    return;
  }
  ++counts_.refused_peers;
  report_warning("peers", "connection from " + address.text() + " is refused: there are " +
                              std::to_string(options_.max_peers) + " already");
  // Without the minutes in which the kernel would remember each of thousands.
  const linger at_once{1, 0};
  setsockopt(socket.get(), SOL_SOCKET, SO_LINGER, &at_once, sizeof(at_once));
}

// The kernel would call for each turn what cannot be accepted now.
void TcpServer::pause() {
  report_warning("accept",
                 std::string("a connection cannot be accepted now: ") + std::strerror(errno));
  loop_.change(listener_.get(), 0);
  resumption_.start(kPause_s, [this] { loop_.change(listener_.get(), PollLoop::kReadable); });
}

}  // namespace trident::bridges
