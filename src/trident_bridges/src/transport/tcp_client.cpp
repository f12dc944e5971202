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
#include "trident_base/string_util.h"

namespace trident::bridges {

TcpClient::TcpClient(const EndpointOptions& options, const EndpointUrl& url, PollLoop& loop,
                     EndpointEvents events)
    : TcpEndpoint(options, loop, std::move(events)), attempt_(loop) {
  const std::uint16_t port = url.port.value_or(options_.default_port);
  if (port == 0) throw Error("url '" + options_.url + "': host port is missing; legal: 1 to 65535");
  server_ = resolve_allowed(options_.url, "host", url.host.empty() ? "127.0.0.1" : url.host, port,
                            options_.allow_remote);
  name_ = "tcp " + server_.text();
  // Not at once: the owner gets this endpoint when the constructor has returned.
  attempt_.start(0.0, [this] { connect(); });
}

TcpClient::~TcpClient() {
  if (connecting_.is_open()) loop_.forget(connecting_.get());
}

void TcpClient::connect() {
  connecting_ = Descriptor(socket(server_.family(), SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!connecting_.is_open()) return fail(errno);
  const std::string buffers =
      set_socket_buffers(connecting_.get(), options_.socket_buffer,
                         std::min(options_.socket_buffer, options_.queue_bytes));
  if (!is_described_) report_notice(buffers);
  is_described_ = true;
  if (::connect(connecting_.get(), server_.get(), server_.size) != 0 && errno != EINPROGRESS) {
    return fail(errno);
  }
  loop_.watch(connecting_.get(), PollLoop::kWritable, [this](std::uint32_t) { finish(); });
}

void TcpClient::finish() {
  loop_.forget(connecting_.get());
  int code = 0;
  socklen_t size = sizeof(code);
  getsockopt(connecting_.get(), SOL_SOCKET, SO_ERROR, &code, &size);
  // The kernel connects a socket to itself when it chose the server's port for it (RFC 9293, 3.5:
  // simultaneous open).
  if (code == 0 && local_address(connecting_.get()) == server_) code = ECONNREFUSED;
  if (code != 0) return fail(code);
  if (was_connected_) ++counts_.reconnects;
  was_connected_ = true;
  forget_warning("connect");
  add(std::move(connecting_), server_.text());
}

void TcpClient::fail(int code) {
  connecting_.reset();
  report_warning("connect", std::string(std::strerror(code)) + "; it is tried again every " +
                                number_text(options_.retry_s) + " s");
  retry();
}

void TcpClient::retry() {
  attempt_.start(options_.retry_s, [this] { connect(); });
}

}  // namespace trident::bridges
