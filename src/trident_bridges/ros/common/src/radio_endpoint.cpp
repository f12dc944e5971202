// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/radio_endpoint.h"

#include <trident_msgs/RadioPacket.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "trident_base/error.h"
#include "trident_base/option_number.h"
#include "trident_base/string_util.h"
#include "trident_bridges_ros/node_publisher.h"

namespace trident::bridges {
namespace {

using trident_msgs::RadioPacket;

constexpr std::string_view kScheme = "radio:";
constexpr std::size_t kLongestPacket = 10'000;  // bytes with the topic (RadioPacket.msg)
constexpr std::uint32_t kQueue = 1000;

// What stands before `mark`; `text` keeps what stands behind it, or nothing.
std::string_view take_until(char mark, std::string_view& text) {
  const auto place = text.find(mark);
  const std::string_view before = text.substr(0, std::min(place, text.size()));
  text = place == std::string_view::npos ? std::string_view() : text.substr(place + 1);
  return before;
}

void read_query(const std::string& where, std::string_view query, RadioUrl& url) {
  while (!query.empty()) {
    std::string_view value = take_until('&', query);
    const std::string key(take_until('=', value));
    const std::string text(value);
    if (key == "priority") {
      url.priority = static_cast<int>(option_count(where + key, text, 0, 3));
    } else if (key == "deadline") {
      url.deadline_s = option_number(where + key, text, 0.0, 1e6);
    } else {
      throw Error(where + unknown_name_text(key, {"priority", "deadline"}));
    }
  }
}

// One robot's radio: blocks go out on ROBOT/radio/send and come in on ROBOT/radio/receive.
class RadioEndpoint : public Endpoint {
 public:
  RadioEndpoint(const EndpointOptions& options, RadioUrl url, NodePollLoop& loop,
                ros::NodeHandle& node, EndpointEvents events)
      : options_(options),
        url_(std::move(url)),
        loop_(loop),
        events_(std::move(events)),
        base_(url_.robot.empty() ? "radio/" : "/" + url_.robot + "/radio/"),
        out_(node, base_ + "send", kQueue),
        in_(loop.subscribe<RadioPacket>(node, base_ + "receive", kQueue,
                                        [this](const RadioPacket& packet) { receive(packet); })) {
    packet_.topic = url_.topic;
    packet_.priority = static_cast<std::uint8_t>(url_.priority);
    packet_.deadline = ros::Duration(url_.deadline_s);
    if (url_.destination.empty()) return;
    const PeerId id = add(url_.destination);
    // The owner gets this endpoint when the constructor has returned.
    first_call_ = loop_.loop().call_after(0.0, [this, id] {
      if (events_.joined) events_.joined(id, url_.destination);
    });
  }
  ~RadioEndpoint() override { loop_.loop().cancel(first_call_); }
  RadioEndpoint(const RadioEndpoint&) = delete;
  RadioEndpoint& operator=(const RadioEndpoint&) = delete;

  bool send(PeerId peer, Bytes block) override {
    const auto known = std::find_if(peers_.begin(), peers_.end(),
                                    [peer](const PeerInfo& info) { return info.id == peer; });
    return known != peers_.end() && send_to(known->address, block);
  }
  int send_batch(PeerId peer, Span<const Bytes> blocks) override {
    int taken = 0;
    for (const Bytes block : blocks) taken += send(peer, block) ? 1 : 0;
    return taken;
  }
  // One packet in either case: a broadcast is heard by all in reach.
  int send_to_all(Bytes block) override { return send_to(url_.destination, block) ? 1 : 0; }
  void drop(PeerId peer) override {
    peers_.erase(std::remove_if(peers_.begin(), peers_.end(),
                                [peer](const PeerInfo& info) { return info.id == peer; }),
                 peers_.end());
  }
  std::vector<PeerInfo> peers() const override { return peers_; }
  std::string name() const override { return "radio " + out_.topic() + " " + url_.topic; }
  std::uint16_t port() const override { return 0; }
  EndpointCounts counts() const override { return counts_; }

 private:
  bool send_to(const std::string& destination, Bytes block) {
    if (block.size() + packet_.topic.size() > kLongestPacket) {
      if (counts_.cut++ == 0 && events_.warning) {
        events_.warning(name() + ": a block of " + std::to_string(block.size()) +
                        " bytes is not sent; legal: up to " +
                        std::to_string(kLongestPacket - packet_.topic.size()));
      }
      return false;
    }
    packet_.destination = destination;
    packet_.data.assign(block.begin(), block.end());
    ++packet_.id;
    out_.publish(packet_);
    ++counts_.sent;
    counts_.sent_bytes += block.size();
    return true;
  }

  void receive(const RadioPacket& packet) {
    if (packet.topic != url_.topic) return;
    const PeerId peer = peer_of(packet.source);
    if (peer == 0) return;
    ++counts_.received;
    counts_.received_bytes += packet.data.size();
    if (events_.received) events_.received(peer, packet.data);
  }

  void note_refused(const std::string& robot) {
    if (counts_.refused_peers++ > 0 || !events_.warning) return;
    events_.warning(name() + ": peer " + robot + " is refused: there are " +
                    std::to_string(options_.max_peers) + " already");
  }

  // 0: there are too many.
  PeerId peer_of(const std::string& robot) {
    for (const PeerInfo& info : peers_) {
      if (info.address == robot) return info.id;
    }
    if (peers_.size() >= options_.max_peers) {
      note_refused(robot);
      return 0;
    }
    const PeerId id = add(robot);
    if (events_.joined) events_.joined(id, robot);
    return id;
  }

  PeerId add(const std::string& robot) {
    peers_.push_back({next_id_, robot});
    return next_id_++;
  }

  EndpointOptions options_;
  RadioUrl url_;
  NodePollLoop& loop_;
  EndpointEvents events_;
  EndpointCounts counts_;
  PeerId next_id_ = 1;
  std::vector<PeerInfo> peers_;
  RadioPacket packet_;
  std::string base_;
  NodePublisher<RadioPacket> out_;
  std::unique_ptr<ros_utils::DirectSubscription> in_;
  std::uint64_t first_call_ = 0;
};

}  // namespace

bool is_radio_url(std::string_view text) { return starts_with(text, kScheme); }

RadioUrl parse_radio_url(std::string_view text) {
  const std::string where = "url '" + std::string(text) + "': ";
  if (!is_radio_url(text)) throw Error(where + "scheme is not radio:");
  RadioUrl url;
  std::string_view query = text.substr(kScheme.size());
  std::string_view rest = take_until('?', query);
  if (starts_with(rest, "//")) {
    rest.remove_prefix(2);
    std::string_view topic = rest;
    std::string_view destination = take_until('/', topic);
    url.robot = std::string(take_until('@', destination));
    url.destination = std::string(destination);
    if (url.robot.empty()) throw Error(where + "robot is missing; legal: radio://ROBOT");
    if (!topic.empty()) url.topic = std::string(topic);
  } else {
    std::string_view topic = rest;
    url.destination = std::string(take_until('/', topic));
    if (!topic.empty()) url.topic = std::string(topic);
  }
  if (url.destination == "all") url.destination.clear();
  read_query(where, query, url);
  return url;
}

std::unique_ptr<Endpoint> open_node_endpoint(const EndpointOptions& options, NodePollLoop& loop,
                                             ros::NodeHandle& node, EndpointEvents events) {
  if (!is_radio_url(options.url)) {
    return open_endpoint(options, loop.loop(), std::move(events));
  }
  return std::make_unique<RadioEndpoint>(options, parse_radio_url(options.url), loop, node,
                                         std::move(events));
}

}  // namespace trident::bridges
