// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "comms/routing/router.h"
#include "trident_sim/comms/radio.h"

namespace trident::sim {

/// Of the radios: that relays listen on, and that routers do.
constexpr int kRelayPort = 1, kHelloPort = 2;

/// A datagram that a third robot is to pass on.
struct ForwardDatagram {
  std::uint8_t hops = 0;      ///< that it may still take
  std::uint8_t priority = 0;  ///< of the rule
  SimTime deadline;           ///< after which it is not worth sending; zero: never
  std::string source, destination;
  std::string_view data;
};

std::string encode(const ForwardDatagram& forward);
/// Empty: the bytes are something else. `data` points into `bytes`.
std::optional<ForwardDatagram> decode_forward(std::string_view bytes);

/// Carries datagrams from robot to robot: straight, or, with routing, over those between them. A
/// value.
class RelayNetwork {
 public:
  explicit RelayNetwork(bool has_routing) : has_routing_(has_routing) {}

  /// Robots with radios, in alphabetical order. What routers of others knew is forgotten.
  void set_robots(const std::vector<std::string>& robots);
  void reset() { routers_.clear(); }
  /// Broadcasts what routers have to say. To be called in every step.
  void send_hellos(SimTime now, Radio& radio);
  /// As Radio::send(), to the next robot of the route; straight where no route is known.
  bool send(const std::string& source, const std::string& destination, std::string data,
            const RadioQos& qos, SimTime now, Radio& radio);
  /// What has come to a robot for itself, from the robots that have sent it first. Passes on what
  /// is for others.
  std::vector<RadioMessage> receive(const std::string& robot, Radio& radio);
  /// From the source over all hops, as the routers have it; straight without routing. Ends where no
  /// route is known.
  std::vector<std::string> route(const std::string& source, const std::string& destination) const;

 private:
  /// A robot's router, and since when it may speak.
  struct Node {
    Router router;
    SimTime speaks_from;
  };
  std::string next_hop(const std::string& robot, const std::string& destination) const;
  void hear_hellos(const std::string& robot, Radio& radio);
  void pass_on(const std::string& robot, ForwardDatagram forward, SimTime now, Radio& radio);

  bool has_routing_;
  std::vector<std::string> robots_;
  std::map<std::string, Node> routers_;
};

}  // namespace trident::sim
