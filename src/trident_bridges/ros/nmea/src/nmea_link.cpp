// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/nmea/nmea_link.h"

#include <ros/console.h>

#include <utility>

#include "trident_bridges/transport/url.h"

namespace trident::bridges {
namespace {

void add(const nmea::FramerCounts& part, nmea::FramerCounts* sum) {
  sum->bytes += part.bytes;
  sum->skipped += part.skipped;
  sum->sentences += part.sentences;
}

bool has_datagrams(const std::string& url) {
  const EndpointKind kind = parse_endpoint_url(url).kind;
  return kind == EndpointKind::kUdp || kind == EndpointKind::kUdpBroadcast ||
         kind == EndpointKind::kUdpPermanentBroadcast;
}

}  // namespace

NmeaLink::NmeaLink(const EndpointOptions& options, const NmeaReadParams& params,
                   NmeaReadHooks hooks, bool listens, PollLoop& loop)
    : params_(params),
      hooks_(std::move(hooks)),
      listens_(listens),
      is_datagrams_(has_datagrams(options.url)) {
  EndpointEvents events;
  events.received = [this](PeerId id, Bytes bytes) { receive(id, bytes); };
  events.joined = [this](PeerId id, const std::string& address) { join(id, address); };
  events.left = [this](PeerId id, const std::string& reason) { leave(id, reason); };
  events.warning = [](const std::string& text) { ROS_WARN("%s", text.c_str()); };
  events.notice = [](const std::string& text) { ROS_INFO("%s", text.c_str()); };
  endpoint_ = open_endpoint(options, loop, std::move(events));
}

void NmeaLink::join(PeerId id, const std::string& address) {
  if (listens_) peers_[id] = std::make_unique<SentenceReader>(name(), address, params_, hooks_);
  ROS_INFO("%s: %s is there", name().c_str(), address.c_str());
}

void NmeaLink::leave(PeerId id, const std::string& reason) {
  ROS_INFO("%s: a peer is gone: %s", name().c_str(), reason.c_str());
  const auto peer = peers_.find(id);
  if (peer == peers_.end()) return;
  add(peer->second->counts(), &gone_);
  peers_.erase(peer);
}

void NmeaLink::receive(PeerId id, Bytes bytes) {
  const auto peer = peers_.find(id);
  if (peer != peers_.end()) peer->second->read(bytes, is_datagrams_);
}

void NmeaLink::send(std::string_view sentence) {
  endpoint_->send_to_all(
      Bytes(reinterpret_cast<const std::uint8_t*>(sentence.data()), sentence.size()));
}

nmea::FramerCounts NmeaLink::framed() const {
  nmea::FramerCounts sum = gone_;
  for (const auto& [id, peer] : peers_) add(peer->counts(), &sum);
  return sum;
}

}  // namespace trident::bridges
