// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/socket.h>

#include <array>
#include <string>
#include <vector>

#include "transport/datagram_batch.h"
#include "transport/descriptor.h"
#include "transport/endpoint_base.h"
#include "transport/udp_peers.h"
#include "trident_bridges/transport/url.h"

namespace trident::bridges {

/// A bound socket that sends to the host of its URL and to those that it has heard from.
class UdpEndpoint : public EndpointBase {
 public:
  /// Throws Error as open_endpoint() does.
  UdpEndpoint(const EndpointOptions& options, const EndpointUrl& url, PollLoop& loop,
              EndpointEvents events);
  ~UdpEndpoint() override;

  bool send(PeerId peer, Bytes block) override;
  int send_batch(PeerId peer, Span<const Bytes> blocks) override;
  int send_to_all(Bytes block) override;
  void drop(PeerId peer) override { peers_.remove(peer); }
  std::vector<PeerInfo> peers() const override;
  std::uint16_t port() const override { return port_; }

 private:
  void open(const EndpointUrl& url);
  void add_given_peer(const EndpointUrl& url);
  void describe(const std::string& buffers, const SocketAddress& bound);
  void read();
  void receive(std::size_t index, double now_s);
  UdpPeers::Peer* peer_of(const SocketAddress& source, double now_s);
  void count_kernel_drops(std::size_t index);
  bool is_addressed(const UdpPeers::Peer& peer) const;
  int send_headers(std::size_t count);
  void expire();

  Descriptor socket_;
  std::uint16_t port_ = 0;
  UdpPeers peers_;
  bool broadcasts_until_answer_ = false;
  DatagramBatch batch_;
  std::uint32_t newest_drops_ = 0;  ///< as the kernel counts them
  std::array<mmsghdr, DatagramBatch::kCapacity> sent_headers_{};
  std::array<iovec, DatagramBatch::kCapacity> sent_parts_{};
  DelayedCall first_call_, expiry_;
};

}  // namespace trident::bridges
