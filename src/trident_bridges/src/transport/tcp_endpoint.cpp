// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "transport/tcp_endpoint.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

namespace trident::bridges {
namespace {

constexpr std::size_t kReadSize = 64 * 1024;
constexpr std::size_t kMaxParts = 32;

// Sends parts with one system call; returns the number of bytes that the socket took. An error
// shows itself at the next read.
std::size_t send_parts(int socket, const iovec* parts, std::size_t count) {
  msghdr header{};
  header.msg_iov = const_cast<iovec*>(parts);
  header.msg_iovlen = count;
  const auto sent = sendmsg(socket, &header, MSG_DONTWAIT | MSG_NOSIGNAL);
  return sent > 0 ? static_cast<std::size_t>(sent) : 0;
}

iovec part_of(Bytes block) { return {const_cast<std::uint8_t*>(block.data()), block.size()}; }

void set_connection_options(int socket) {
  const int on = 1;
  setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
  setsockopt(socket, SOL_SOCKET, SO_KEEPALIVE, &on, sizeof(on));
}

}  // namespace

TcpEndpoint::TcpEndpoint(const EndpointOptions& options, PollLoop& loop, EndpointEvents events)
    : EndpointBase(options, loop, std::move(events)), buffer_(kReadSize) {}

TcpEndpoint::~TcpEndpoint() {
  for (const auto& connection : connections_) loop_.forget(connection->socket.get());
}

void TcpEndpoint::add(Descriptor socket, const std::string& address) {
  set_connection_options(socket.get());
  const PeerId id = next_id_++;
  const int descriptor = socket.get();
  connections_.push_back(std::make_unique<Connection>(
      Connection{id, std::move(socket), address, ByteQueue(options_.queue_bytes)}));
  loop_.watch(descriptor, PollLoop::kReadable, [this, id](std::uint32_t what) { ready(id, what); });
  report_joined(id, address);
}

TcpEndpoint::Connection* TcpEndpoint::find(PeerId id) {
  for (const auto& connection : connections_) {
    if (connection->id == id) return connection.get();
  }
  return nullptr;
}

void TcpEndpoint::ready(PeerId id, std::uint32_t what) {
  Connection* const connection = find(id);
  if (connection == nullptr) return;
  if ((what & PollLoop::kWritable) != 0) flush(*connection);
  if ((what & (PollLoop::kReadable | PollLoop::kClosed)) != 0) read(id, connection->socket.get());
}

// One read a turn, so that a fast peer does not hold up the others.
void TcpEndpoint::read(PeerId id, int socket) {
  const auto size = recv(socket, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
  if (size > 0) {
    report_received(id, {buffer_.data(), static_cast<std::size_t>(size)});
  } else if (size == 0) {
    end(id, "closed by the peer");
  } else if (errno != EAGAIN && errno != EINTR) {
    end(id, std::strerror(errno));
  }
}

int TcpEndpoint::send_batch(PeerId peer, Span<const Bytes> blocks) {
  Connection* const connection = find(peer);
  return connection == nullptr ? 0 : take(*connection, blocks);
}

int TcpEndpoint::send_to_all(Bytes block) {
  int taken = 0;
  for (const auto& connection : connections_) taken += take(*connection, {&block, 1});
  return taken;
}

// A block is taken whole or not at all: half a frame would cost the peer the next one, too.
int TcpEndpoint::take(Connection& connection, Span<const Bytes> blocks) {
  int taken = 0;
  for (std::size_t begin = 0; begin < blocks.size();) {
    const Span<const Bytes> some =
        blocks.subspan(begin, std::min(kMaxParts, blocks.size() - begin));
    std::size_t written = connection.queue.empty() ? write_now(connection, some) : 0;
    for (const Bytes block : some) {
      const std::size_t part = std::min(written, block.size());
      written -= part;
      const bool is_begun = part > 0 || block.empty();
      if (!is_begun && block.size() > connection.queue.free_bytes()) {
        ++counts_.cut;
        continue;
      }
      if (part < block.size()) queue_rest(connection, block.subspan(part));
      count_sent(block.size());
      ++taken;
    }
    begin += some.size();
  }
  return taken;
}

// What is written of blocks whose rest would not fit the queue could not be completed: such blocks
// and those after them wait or are cut.
std::size_t TcpEndpoint::write_now(const Connection& connection, Span<const Bytes> blocks) {
  std::array<iovec, kMaxParts> parts;
  std::size_t count = 0;
  for (const Bytes block : blocks) {
    if (block.size() > options_.queue_bytes) break;
    parts[count++] = part_of(block);
  }
  return send_parts(connection.socket.get(), parts.data(), count);
}

void TcpEndpoint::queue_rest(Connection& connection, Bytes rest) {
  if (connection.queue.empty()) {
    loop_.change(connection.socket.get(), PollLoop::kReadable | PollLoop::kWritable);
  }
  connection.queue.push(rest);
}

void TcpEndpoint::flush(Connection& connection) {
  const std::array<Bytes, 2> waiting = connection.queue.front(connection.queue.size());
  const std::array<iovec, 2> parts{part_of(waiting[0]), part_of(waiting[1])};
  connection.queue.pop(send_parts(connection.socket.get(), parts.data(), parts.size()));
  if (connection.queue.empty()) loop_.change(connection.socket.get(), PollLoop::kReadable);
}

void TcpEndpoint::drop(PeerId peer) {
  if (erase(peer)) connection_ended();
}

void TcpEndpoint::end(PeerId id, const std::string& reason) {
  if (!erase(id)) return;
  report_left(id, reason);
  connection_ended();
}

bool TcpEndpoint::erase(PeerId id) {
  const auto is_it = [id](const auto& connection) { return connection->id == id; };
  const auto found = std::find_if(connections_.begin(), connections_.end(), is_it);
  if (found == connections_.end()) return false;
  loop_.forget((*found)->socket.get());
  connections_.erase(found);
  return true;
}

std::vector<PeerInfo> TcpEndpoint::peers() const {
  std::vector<PeerInfo> result;
  for (const auto& connection : connections_) {
    result.push_back({connection->id, connection->address});
  }
  return result;
}

}  // namespace trident::bridges
