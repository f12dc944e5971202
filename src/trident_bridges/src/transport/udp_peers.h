// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "transport/socket_address.h"
#include "transport/token_bucket.h"
#include "trident_bridges/transport/endpoint.h"

namespace trident::bridges {

/// The addresses that a UDP socket sends to: those that it was given and those that it has learnt
/// from datagrams. A learnt one is forgotten when it has been silent for too long.
class UdpPeers {
 public:
  /// How many and how long.
  struct Limits {
    std::size_t max_peers = 16;     ///< given and learnt together
    double max_rate = 20000.0;      ///< datagrams of a peer [1/s]
    double silence_limit_s = 60.0;  ///< of a learnt peer [s]
  };
  /// One address.
  struct Peer {
    PeerId id;
    SocketAddress address;
    bool is_learnt;
    double heard_s;      ///< when its last datagram came [s]
    TokenBucket bucket;  ///< of its datagrams
  };

  /// Nobody at first.
  explicit UdpPeers(const Limits& limits) : limits_(limits) {}

  /// Adds a peer that is never forgotten.
  PeerId add(const SocketAddress& address) { return append(address, false, 0.0).id; }

  /// The peer at an address; nullptr: it is unknown.
  Peer* find(const SocketAddress& address) {
    // The same peer often sends several datagrams in turn.
    if (last_ < peers_.size() && peers_[last_].address == address) return &peers_[last_];
    for (std::size_t i = 0; i < peers_.size(); ++i) {
      if (!(peers_[i].address == address)) continue;
      last_ = i;
      return &peers_[i];
    }
    return nullptr;
  }
  /// The peer of a number; nullptr: it is unknown.
  Peer* find(PeerId id) {
    for (Peer& peer : peers_) {
      if (peer.id == id) return &peer;
    }
    return nullptr;
  }

  /// Adds a peer that sent a datagram; nullptr: there are too many.
  Peer* learn(const SocketAddress& address, double now_s) {
    if (peers_.size() >= limits_.max_peers) return nullptr;
    return &append(address, true, now_s);
  }

  /// Removes learnt peers that have been silent for too long, and calls `gone` with each.
  template <class Gone>
  void expire(double now_s, Gone gone) {
    for (std::size_t i = 0; i < peers_.size();) {
      const Peer& peer = peers_[i];
      if (!peer.is_learnt || now_s - peer.heard_s <= limits_.silence_limit_s) {
        ++i;
        continue;
      }
      const PeerId id = peer.id;
      peers_.erase(peers_.begin() + static_cast<std::ptrdiff_t>(i));
      gone(id);
    }
  }

  /// Removes one; nothing happens when it is unknown.
  void remove(PeerId id) {
    for (std::size_t i = 0; i < peers_.size(); ++i) {
      if (peers_[i].id != id) continue;
      peers_.erase(peers_.begin() + static_cast<std::ptrdiff_t>(i));
      return;
    }
  }

  const std::vector<Peer>& all() const { return peers_; }  ///< in the order in which they came

 private:
  Peer& append(const SocketAddress& address, bool is_learnt, double now_s) {
    peers_.push_back({next_id_++, address, is_learnt, now_s, TokenBucket(limits_.max_rate)});
    return peers_.back();
  }

  Limits limits_;
  PeerId next_id_ = 1;
  std::vector<Peer> peers_;
  std::size_t last_ = 0;  ///< the index that find() returned last
};

}  // namespace trident::bridges
