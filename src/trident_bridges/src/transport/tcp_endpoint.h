// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "transport/byte_queue.h"
#include "transport/descriptor.h"
#include "transport/endpoint_base.h"
#include "transport/socket_address.h"
#include "trident_bridges/transport/url.h"

namespace trident::bridges {

/// The connections of a TCP endpoint. What a peer does not take at once waits in its own queue, so
/// that a slow one holds nobody up.
class TcpEndpoint : public EndpointBase {
 public:
  ~TcpEndpoint() override;

  bool send(PeerId peer, Bytes block) override { return send_batch(peer, {&block, 1}) == 1; }
  int send_batch(PeerId peer, Span<const Bytes> blocks) override;
  int send_to_all(Bytes block) override;
  void drop(PeerId peer) override;
  std::vector<PeerInfo> peers() const override;

 protected:
  TcpEndpoint(const EndpointOptions& options, PollLoop& loop, EndpointEvents events);

  /// Takes over a connected socket, which does not block, and reports the peer.
  void add(Descriptor socket, const std::string& address);
  /// How many there are.
  std::size_t connection_count() const { return connections_.size(); }
  /// Called when a connection has ended, by whichever end.
  virtual void connection_ended() {}

 private:
  struct Connection {
    PeerId id;
    Descriptor socket;
    std::string address;
    ByteQueue queue;
  };

  Connection* find(PeerId id);
  void ready(PeerId id, std::uint32_t ready);
  void read(PeerId id, int socket);
  void flush(Connection& connection);
  int take(Connection& connection, Span<const Bytes> blocks);
  std::size_t write_now(const Connection& connection, Span<const Bytes> blocks);
  void queue_rest(Connection& connection, Bytes rest);
  void end(PeerId id, const std::string& reason);
  bool erase(PeerId id);

  PeerId next_id_ = 1;
  std::vector<std::unique_ptr<Connection>> connections_;
  std::vector<std::uint8_t> buffer_;  ///< of what is read
};

/// Accepts connections up to the limit; closes those beyond it at once.
class TcpServer : public TcpEndpoint {
 public:
  /// Throws Error as open_endpoint() does.
  TcpServer(const EndpointOptions& options, const EndpointUrl& url, PollLoop& loop,
            EndpointEvents events);
  ~TcpServer() override;
  std::uint16_t port() const override { return port_; }

 private:
  void open(const EndpointUrl& url);
  void accept_some();
  void admit(Descriptor socket, const SocketAddress& address);
  void pause();

  Descriptor listener_;
  std::uint16_t port_ = 0;
  DelayedCall resumption_;
};

/// Connects to a server, and again whenever the connection has ended.
class TcpClient : public TcpEndpoint {
 public:
  /// Throws Error as open_endpoint() does.
  TcpClient(const EndpointOptions& options, const EndpointUrl& url, PollLoop& loop,
            EndpointEvents events);
  ~TcpClient() override;
  std::uint16_t port() const override { return 0; }

 protected:
  void connection_ended() override { retry(); }

 private:
  void connect();
  void finish();
  void fail(int code);
  void retry();

  SocketAddress server_;
  Descriptor connecting_;
  bool is_described_ = false, was_connected_ = false;
  DelayedCall attempt_;
};

}  // namespace trident::bridges
