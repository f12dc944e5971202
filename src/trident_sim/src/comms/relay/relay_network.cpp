// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "comms/relay/relay_network.h"

#include <algorithm>
#include <utility>

#include "comms/wire.h"

namespace trident::sim {
namespace {

constexpr char kForward = 'F';
// Routes have no loop; one that follows routes of several moments may still wander.
constexpr std::uint8_t kMaxHops = 32;
// So long others know a router that was there before under the same name (see Router).
constexpr SimTime kSilence{600'000'000};

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::binary_search(names.begin(), names.end(), name);
}

}  // namespace

std::string encode(const ForwardDatagram& forward) {
  std::string bytes(1, kForward);
  wire::put(forward.hops, &bytes);
  wire::put(forward.priority, &bytes);
  wire::put(forward.deadline.ns, &bytes);
  for (const std::string* name : {&forward.source, &forward.destination}) {
    wire::put(static_cast<std::uint16_t>(name->size()), &bytes);
    bytes += *name;
  }
  return bytes.append(forward.data);
}

std::optional<ForwardDatagram> decode_forward(std::string_view bytes) {
  wire::Fields fields(bytes);
  if (fields.get<char>() != kForward) return std::nullopt;
  ForwardDatagram forward;
  forward.hops = fields.get<std::uint8_t>();
  forward.priority = fields.get<std::uint8_t>();
  forward.deadline.ns = fields.get<std::int64_t>();
  for (std::string* name : {&forward.source, &forward.destination}) {
    *name = fields.text(fields.get<std::uint16_t>());
  }
  forward.data = fields.rest();
  const bool is_legal = fields.is_whole() && forward.hops <= kMaxHops && forward.priority <= 3;
  return is_legal ? std::optional(forward) : std::nullopt;
}

void RelayNetwork::set_robots(const std::vector<std::string>& robots) {
  robots_ = robots;
  for (auto node = routers_.begin(); node != routers_.end();) {
    node = has(robots_, node->first) ? std::next(node) : routers_.erase(node);
  }
}

void RelayNetwork::send_hellos(SimTime now, Radio& radio) {
  if (!has_routing_) return;
  for (const std::string& robot : robots_) {
    auto known = routers_.find(robot);
    if (known == routers_.end()) {
      RouterParams params;
      params.is_base_station = radio.limits(robot).is_base_station;
      // At time zero nobody can remember a router of that name.
      const SimTime from = now.ns > 0 ? now + kSilence : now;
      known = routers_.emplace(robot, Node{Router(robot, params), from}).first;
    }
    Node& node = known->second;
    if (now < node.speaks_from) continue;
    RadioQos qos;
    qos.port = kHelloPort;
    qos.priority = 0;
    if (auto hello = node.router.due_hello(now)) {
      radio.send(robot, Radio::kAll, std::move(*hello), qos);
    }
  }
}

std::string RelayNetwork::next_hop(const std::string& robot, const std::string& destination) const {
  const auto node = routers_.find(robot);
  if (node == routers_.end()) return destination;
  return node->second.router.next_hop(destination).value_or(destination);
}

bool RelayNetwork::send(const std::string& source, const std::string& destination, std::string data,
                        const RadioQos& qos, SimTime now, Radio& radio) {
  const std::string hop = destination == Radio::kAll ? destination : next_hop(source, destination);
  // A neighbor is reached without the overhead of forwarding.
  if (hop == destination) return radio.send(source, destination, std::move(data), qos);
  ForwardDatagram forward;
  forward.hops = kMaxHops;
  forward.priority = static_cast<std::uint8_t>(qos.priority);
  if (qos.deadline_s > 0.0) forward.deadline = now + SimTime::from_seconds(qos.deadline_s);
  forward.source = source;
  forward.destination = destination;
  forward.data = data;
  return radio.send(source, hop, encode(forward), qos);
}

void RelayNetwork::pass_on(const std::string& robot, ForwardDatagram forward, SimTime now,
                           Radio& radio) {
  // A datagram that wanders, or whose destination has gone, is dropped silently.
  if (forward.hops == 0 || !has(robots_, forward.destination)) return;
  --forward.hops;
  RadioQos qos;
  qos.port = kRelayPort;
  qos.priority = forward.priority;
  if (forward.deadline.ns > 0) {
    qos.deadline_s = (forward.deadline - now).seconds();
    if (qos.deadline_s <= 0.0) return;
  }
  // As it is on the last hop, too: the radio alone would name this robot as the source.
  radio.send(robot, next_hop(robot, forward.destination), encode(forward), qos);
}

void RelayNetwork::hear_hellos(const std::string& robot, Radio& radio) {
  const auto node = routers_.find(robot);
  if (node == routers_.end()) return;
  for (const RadioMessage& hello : radio.receive(robot, kHelloPort)) {
    // The rate towards the sender counts, as packets go against the direction of its hello.
    node->second.router.hear(hello.data, hello.source, radio.rate_bit_s(robot, hello.source),
                             hello.received);
  }
}

std::vector<RadioMessage> RelayNetwork::receive(const std::string& robot, Radio& radio) {
  if (has_routing_) hear_hellos(robot, radio);
  std::vector<RadioMessage> own;
  for (RadioMessage& message : radio.receive(robot, kRelayPort)) {
    auto forward = decode_forward(message.data);
    if (!forward) {
      own.push_back(std::move(message));
    } else if (forward->destination == robot) {
      own.push_back({forward->source, std::string(forward->data), message.sent, message.received,
                     message.snr_db});
    } else {
      pass_on(robot, std::move(*forward), message.received, radio);
    }
  }
  return own;
}

std::vector<std::string> RelayNetwork::route(const std::string& source,
                                             const std::string& destination) const {
  std::vector<std::string> result{source};
  while (result.back() != destination && result.size() <= kMaxHops) {
    const auto node = routers_.find(result.back());
    if (!has_routing_ || node == routers_.end()) {
      // Without routing everybody sends to the destination itself.
      result.push_back(destination);
      continue;
    }
    const auto hop = node->second.router.next_hop(destination);
    if (!hop) break;
    result.push_back(*hop);
  }
  return result;
}

}  // namespace trident::sim
