// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "trident_base/sim_time.h"
#include "trident_bridges/mavlink/packet_parser.h"
#include "trident_bridges/mavlink/sequence_tracker.h"

namespace trident::bridges::mavlink {

/// Number that the owner gives to each end that is connected.
using RouterPeer = std::uint32_t;

/// Limits of a router.
struct RouterOptions {
  std::size_t max_peers = 16;     ///< more are refused
  double max_rate_hz = 20'000.0;  ///< packets of one peer; more are dropped
  double expiry_s = 60.0;         ///< an id that is silent for longer is forgotten
  bool accept_mavlink1 = false;   ///< forward MAVLink 1, too
};

/// Of one peer, since it was added.
struct RouterCounts {
  std::uint64_t received = 0;        ///< packets from it
  std::uint64_t forwarded = 0;       ///< packets to it
  std::uint64_t over_rate = 0;       ///< dropped: more than max_rate_hz
  std::uint64_t unknown_target = 0;  ///< dropped: for a system that nobody has heard
  std::uint64_t setup_signing = 0;   ///< dropped: keys are not passed on
};

/// Where a system's component is.
struct Route {
  RouterPeer peer = 0;  ///< the end that it was last heard from
  SimTime heard;        ///< when
  SimTime warned;       ///< when its last change was named
};

/// Forwards packets between peers as they are, by https://mavlink.io/en/guide/routing.html: what is
/// for all goes to all others, what is for a system goes to where it was heard. It signs for
/// nobody, and SETUP_SIGNING goes nowhere.
class Router {
 public:
  /// `send` gets each packet that a peer is to have. `warning` gets one sentence for what a user
  /// should know: an id that two peers have, a peer that is refused. `now` of the other calls is
  /// wall time, monotonic.
  Router(const RouterOptions& options, std::function<void(RouterPeer, Bytes)> send,
         std::function<void(const std::string&)> warning);

  /// A peer is there. False: it is one too many, or its number is taken.
  bool add_peer(RouterPeer peer, const std::string& name);
  /// From now on the peer also gets what is for others.
  void let_hear_all(RouterPeer peer) { listeners_.push_back(peer); }
  /// It is gone, and all ids that it had.
  void remove_peer(RouterPeer peer);
  /// Forwards what a peer sent: a datagram, or the next piece of its stream. Of a peer that was not
  /// added nothing is forwarded.
  void receive(RouterPeer peer, Bytes bytes, bool is_datagram, SimTime now);
  /// Forgets ids that are silent; to be called about once a second.
  void update(SimTime now);

  const std::map<Address, Route>& routes() const { return routes_; }  ///< of all ids known now
  const RouterCounts* counts(RouterPeer peer) const;                  ///< nullptr: no such peer
  const SequenceTracker* sequences(RouterPeer peer) const;   ///< losses on the path from that peer
  const ParserCounts* parser_counts(RouterPeer peer) const;  ///< bad packets from that peer

 private:
  struct Peer {
    std::string name;
    PacketParser parser;
    SequenceTracker sequences;
    RouterCounts counts;
    double budget = 0.0;  // packets that it may send now
    SimTime budgeted;
  };

  bool is_within_rate(Peer& peer, SimTime now) const;
  void learn(Address source, RouterPeer from, SimTime now);
  void forward(const Packet& packet, RouterPeer from);
  void add_receiver(RouterPeer peer, RouterPeer from);
  bool add_routes(Address target, RouterPeer from);
  void find_receivers(Address target, RouterPeer from);
  void send_to(RouterPeer to, Bytes packet);
  const Peer* find(RouterPeer peer) const;

  RouterOptions options_;
  std::function<void(RouterPeer, Bytes)> send_;
  std::function<void(const std::string&)> warning_;
  std::map<RouterPeer, Peer> peers_;
  std::map<Address, Route> routes_;
  std::vector<RouterPeer> listeners_;  // get all packets
  std::vector<RouterPeer> receivers_;  // of the packet that is being forwarded
};

}  // namespace trident::bridges::mavlink
