// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "core/link.h"

#include <ros/time.h>

#include <utility>

#include "trident_base/sim_time.h"
#include "trident_bridges/transport/url.h"

namespace trident::mavros {
namespace {

using bridges::Bytes;
using bridges::EndpointKind;
using bridges::PeerId;
using bridges::mavlink::RouterPeer;

constexpr RouterPeer kThisNode = 0;
constexpr RouterPeer kEnds = 2;  // numbers of the peers of both ends alternate
constexpr std::uint16_t kStationsPort = 14550;
constexpr double kLook_s = 1.0;

/// Numbers that no two peers of the router share.
RouterPeer router_peer(std::size_t end, PeerId peer) {
  return 1 + peer * kEnds + static_cast<RouterPeer>(end);
}

bool has_datagrams(const std::string& url) {
  const EndpointKind kind = bridges::parse_endpoint_url(url).kind;
  return kind == EndpointKind::kUdp || kind == EndpointKind::kUdpBroadcast ||
         kind == EndpointKind::kUdpPermanentBroadcast;
}

SimTime wall_time(const bridges::PollLoop& loop) { return SimTime::from_seconds(loop.now_s()); }

bridges::mavlink::RouterOptions router_options(double max_peer_rate) {
  bridges::mavlink::RouterOptions options;
  options.accept_mavlink1 = true;
  options.max_rate_hz = max_peer_rate;
  return options;
}

bridges::mavlink::SigningTime signing_now() {
  return bridges::mavlink::signing_time(static_cast<std::int64_t>(ros::WallTime::now().toNSec()));
}

}  // namespace

LinkKey::LinkKey(const std::string& file) {
  if (file.empty()) return;
  store_ = std::make_unique<bridges::mavlink::SigningFile>(file + ".mavros.times");
  signing_ = std::make_unique<bridges::mavlink::Signing>(bridges::mavlink::read_signing_key(file),
                                                         store_.get(), signing_now());
  signer_ = std::make_unique<bridges::mavlink::PacketSigner>(*signing_, 0);
}

std::string LinkKey::refusal(const Packet& packet) {
  if (!signing_) return "";
  signing_->advance(signing_now());
  const auto verdict = signing_->check(packet);
  if (verdict == bridges::mavlink::SignatureVerdict::kAccepted) return "";
  return "a packet of system " + std::to_string(packet.source.system) +
         " is dropped: " + bridges::mavlink::text_of(verdict);
}

Link::Link(const LinkOptions& options, bridges::PollLoop& loop, Events events)
    : loop_(loop),
      events_(std::move(events)),
      key_(options.signing_key_file),
      router_(
          router_options(options.max_peer_rate),
          [this](RouterPeer peer, Bytes packet) { pass_on(peer, packet); }, events_.warning),
      parser_(true),
      writer_(key_.signer()) {
  router_.add_peer(kThisNode, "this node");
  // What a vehicle answers to a ground station shows that its mission has changed.
  router_.let_hear_all(kThisNode);
  open(options.fcu_url, options, loop);
  if (!options.gcs_url.empty()) open(options.gcs_url, options, loop);
  forget_silent_ids(loop);
}

Link::~Link() { loop_.cancel(next_look_); }

void Link::open(const std::string& url, const LinkOptions& link, bridges::PollLoop& loop) {
  const std::size_t number = ends_.size();
  const bool is_datagram = has_datagrams(url);
  bridges::EndpointOptions options;
  options.url = url;
  options.allow_remote = link.allow_remote;
  options.max_peer_rate = link.max_peer_rate;
  options.default_bind_port = kDefaultBindPort;
  options.default_port = kStationsPort;
  ends_.push_back(std::make_unique<End>());
  End& end = *ends_.back();
  bridges::EndpointEvents events;
  events.received = [this, number, is_datagram](PeerId peer, Bytes bytes) {
    router_.receive(router_peer(number, peer), bytes, is_datagram, wall_time(loop_));
    hear();
  };
  events.joined = [this, number](PeerId peer, const std::string& address) {
    router_.add_peer(router_peer(number, peer), address);
  };
  events.left = [this, number, &end](PeerId peer, const std::string& reason) {
    router_.remove_peer(router_peer(number, peer));
    events_.warning(end.endpoint->name() + ": " + reason);
  };
  events.warning = events_.warning;
  events.notice = events_.notice;
  end.endpoint = bridges::open_endpoint(options, loop, std::move(events));
}

void Link::forget_silent_ids(bridges::PollLoop& loop) {
  router_.update(wall_time(loop));
  next_look_ = loop.call_after(kLook_s, [this] { forget_silent_ids(loop_); });
}

void Link::pass_on(RouterPeer peer, Bytes packet) {
  if (peer != kThisNode) {
    const RouterPeer number = peer - 1;
    ends_[number % kEnds]->endpoint->send(number / kEnds, packet);
    return;
  }
  inbox_.insert(inbox_.end(), packet.begin(), packet.end());
}

void Link::hear() {
  heard_.swap(inbox_);
  inbox_.clear();
  parser_.feed_datagram(bridges::Bytes(heard_));
  while (const auto found = parser_.next()) {
    const std::string refusal = key_.refusal(*found);
    refusal.empty() ? events_.received(*found) : events_.refused(refusal);
  }
}

void Link::send(const Message& message) { send_packet(writer_.write(message)); }

void Link::send_packet(Bytes packet) { router_.receive(kThisNode, packet, true, wall_time(loop_)); }

}  // namespace trident::mavros
