// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/router.h"

#include <algorithm>
#include <utility>

#include "trident_bridges/mavlink/dialect.h"

namespace trident::bridges::mavlink {
namespace {

constexpr double kWarnAgain_s = 10.0;  // about an id that two peers have

std::string text_of(Address address) {
  return "system " + std::to_string(address.system) + " component " +
         std::to_string(address.component);
}

}  // namespace

Router::Router(const RouterOptions& options, std::function<void(RouterPeer, Bytes)> send,
               std::function<void(const std::string&)> warning)
    : options_(options), send_(std::move(send)), warning_(std::move(warning)) {}

bool Router::add_peer(RouterPeer peer, const std::string& name) {
  if (peers_.count(peer) != 0) return false;
  if (peers_.size() >= options_.max_peers) {
    if (warning_) {
      warning_("router: " + name + " is refused: there are " + std::to_string(peers_.size()) +
               " peers, legal: up to " + std::to_string(options_.max_peers));
    }
    return false;
  }
  Peer added{name, PacketParser(options_.accept_mavlink1), {}, {}, options_.max_rate_hz, {}};
  peers_.emplace(peer, std::move(added));
  return true;
}

void Router::remove_peer(RouterPeer peer) {
  peers_.erase(peer);
  listeners_.erase(std::remove(listeners_.begin(), listeners_.end(), peer), listeners_.end());
  for (auto it = routes_.begin(); it != routes_.end();) {
    it = it->second.peer == peer ? routes_.erase(it) : std::next(it);
  }
}

void Router::receive(RouterPeer peer, Bytes bytes, bool is_datagram, SimTime now) {
  const auto it = peers_.find(peer);
  if (it == peers_.end()) return;
  Peer& from = it->second;
  is_datagram ? from.parser.feed_datagram(bytes) : from.parser.feed(bytes);
  while (const std::optional<Packet> packet = from.parser.next()) {
    ++from.counts.received;
    from.sequences.note(packet->source, packet->sequence);
    if (!is_within_rate(from, now)) {
      ++from.counts.over_rate;
      continue;
    }
    learn(packet->source, peer, now);
    forward(*packet, peer);
  }
}

/// A bucket that fills at the legal rate and holds a second's packets.
bool Router::is_within_rate(Peer& peer, SimTime now) const {
  peer.budget = std::min(options_.max_rate_hz,
                         peer.budget + options_.max_rate_hz * (now - peer.budgeted).seconds());
  peer.budgeted = now;
  if (peer.budget < 1.0) return false;
  peer.budget -= 1.0;
  return true;
}

void Router::learn(Address source, RouterPeer from, SimTime now) {
  const auto [it, is_new] = routes_.try_emplace(source, Route{from, now, {}});
  Route& route = it->second;
  route.heard = now;
  if (is_new || route.peer == from) return;
  const bool was_named = route.warned.ns != 0 && (now - route.warned).seconds() < kWarnAgain_s;
  if (warning_ && !was_named) {
    warning_("router: " + text_of(source) + " was heard from " + peers_.at(route.peer).name +
             ", now from " + peers_.at(from).name + ": do two have one id?");
    route.warned = now;
  }
  route.peer = from;
}

void Router::forward(const Packet& packet, RouterPeer from) {
  if (packet.id == MAVLINK_MSG_ID_SETUP_SIGNING) {
    ++peers_.at(from).counts.setup_signing;
    return;
  }
  const Address target = target_of(packet);
  if (target.system == 0) {
    for (auto& [number, peer] : peers_) {
      if (number != from) send_to(number, packet.raw);
    }
    return;
  }
  find_receivers(target, from);
  for (const RouterPeer receiver : receivers_) send_to(receiver, packet.raw);
}

void Router::add_receiver(RouterPeer peer, RouterPeer from) {
  const bool is_listed = std::find(receivers_.begin(), receivers_.end(), peer) != receivers_.end();
  if (peer != from && !is_listed) receivers_.push_back(peer);
}

/// Adds the peers behind which the target is; false: it was not heard.
bool Router::add_routes(Address target, RouterPeer from) {
  bool is_known = false;
  for (const auto& [address, route] : routes_) {
    if (!is_for(target, address)) continue;
    is_known = true;
    add_receiver(route.peer, from);
  }
  return is_known;
}

void Router::find_receivers(Address target, RouterPeer from) {
  receivers_.clear();
  const Address any_component{target.system, 0};
  const bool is_known = add_routes(target, from) || add_routes(any_component, from);
  if (!is_known) ++peers_.at(from).counts.unknown_target;
  for (const RouterPeer listener : listeners_) add_receiver(listener, from);
}

void Router::send_to(RouterPeer to, Bytes packet) {
  ++peers_.at(to).counts.forwarded;
  send_(to, packet);
}

void Router::update(SimTime now) {
  for (auto it = routes_.begin(); it != routes_.end();) {
    const bool is_old = (now - it->second.heard).seconds() > options_.expiry_s;
    it = is_old ? routes_.erase(it) : std::next(it);
  }
}

const Router::Peer* Router::find(RouterPeer peer) const {
  const auto it = peers_.find(peer);
  return it == peers_.end() ? nullptr : &it->second;
}

const RouterCounts* Router::counts(RouterPeer peer) const {
  const Peer* found = find(peer);
  return found == nullptr ? nullptr : &found->counts;
}

const SequenceTracker* Router::sequences(RouterPeer peer) const {
  const Peer* found = find(peer);
  return found == nullptr ? nullptr : &found->sequences;
}

const ParserCounts* Router::parser_counts(RouterPeer peer) const {
  const Peer* found = find(peer);
  return found == nullptr ? nullptr : &found->parser.counts();
}

}  // namespace trident::bridges::mavlink
