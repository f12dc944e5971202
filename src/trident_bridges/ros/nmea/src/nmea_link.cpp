// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/nmea/nmea_link.h"

#include <ros/console.h>

#include <utility>

#include "trident_bridges/transport/url.h"
#include "trident_bridges_ros/radio_endpoint.h"

namespace trident::bridges {
namespace {

void add(const nmea::FramerCounts& part, nmea::FramerCounts* sum) {
  sum->bytes += part.bytes;
  sum->skipped += part.skipped;
  sum->sentences += part.sentences;
}

constexpr double kCloselyS = 50e-6;         ///< between sentences that are sent together
constexpr std::size_t kMaxWaiting = 8'192;  ///< fits into a packet of a radio [bytes]

bool has_datagrams(const std::string& url) {
  if (is_radio_url(url)) return true;
  const EndpointKind kind = parse_endpoint_url(url).kind;
  return kind == EndpointKind::kUdp || kind == EndpointKind::kUdpBroadcast ||
         kind == EndpointKind::kUdpPermanentBroadcast;
}

// Whether a block has a cost of its own, and several sentences may be one.
bool is_gathering(const std::string& url) {
  if (is_radio_url(url)) return true;
  const EndpointKind kind = parse_endpoint_url(url).kind;
  return kind == EndpointKind::kTcpServer || kind == EndpointKind::kTcpClient;
}

}  // namespace

NmeaLink::NmeaLink(const EndpointOptions& options, const NmeaReadParams& params,
                   NmeaReadHooks hooks, bool listens, NodePollLoop& loop, ros::NodeHandle& node)
    : params_(params),
      hooks_(std::move(hooks)),
      loop_(loop.loop()),
      listens_(listens),
      is_datagrams_(has_datagrams(options.url)),
      is_gathering_(is_gathering(options.url)) {
  waiting_.reserve(kMaxWaiting);
  EndpointEvents events;
  events.received = [this](PeerId id, Bytes bytes) { receive(id, bytes); };
  events.joined = [this](PeerId id, const std::string& address) { join(id, address); };
  events.left = [this](PeerId id, const std::string& reason) { leave(id, reason); };
  events.warning = [](const std::string& text) { ROS_WARN("%s", text.c_str()); };
  events.notice = [](const std::string& text) { ROS_INFO("%s", text.c_str()); };
  endpoint_ = open_node_endpoint(options, loop, node, std::move(events));
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
  if (!is_gathering_) {
    send_now(sentence);
    return;
  }
  const double now_s = loop_.now_s();
  const bool is_close = now_s - sent_s_ < kCloselyS;
  sent_s_ = now_s;
  if (waiting_.empty() && !is_close) {
    send_now(sentence);
    return;
  }
  if (waiting_.size() + sentence.size() > kMaxWaiting) flush();
  if (waiting_.empty()) loop_.post([this] { flush(); });
  waiting_ += sentence;
}

void NmeaLink::flush() {
  if (!waiting_.empty()) send_now(waiting_);
  waiting_.clear();
}

void NmeaLink::send_now(std::string_view text) {
  endpoint_->send_to_all(Bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

nmea::FramerCounts NmeaLink::framed() const {
  nmea::FramerCounts sum = gone_;
  for (const auto& [id, peer] : peers_) add(peer->counts(), &sum);
  return sum;
}

}  // namespace trident::bridges
