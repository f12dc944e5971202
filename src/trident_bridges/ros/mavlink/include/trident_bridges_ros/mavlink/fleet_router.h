// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "trident_bridges/mavlink/message.h"
#include "trident_bridges/mavlink/packet_parser.h"
#include "trident_bridges/mavlink/packet_writer.h"
#include "trident_bridges/mavlink/router.h"
#include "trident_bridges/transport/endpoint.h"
#include "trident_bridges/transport/poll_loop.h"

namespace trident::bridges {

class VehicleKey;

/// The one TCP port that carries all vehicles. What is for a vehicle is handed over by
/// deliver(), never within send(), because a vehicle answers at once.
class FleetRouter {
 public:
  /// What it is opened with.
  struct Setup {
    std::uint16_t port = 0;     ///< of its TCP server
    bool allow_remote = false;  ///< may be reached from other computers
  };
  /// A message has come for a vehicle; the text names the port.
  using Received = std::function<void(const mavlink::Message&, const std::string& from)>;

  /// Throws Error when the port cannot be bound. `loop` must outlive it. `arrived`: something waits
  /// for deliver().
  FleetRouter(const Setup& setup, PollLoop& loop, std::function<void()> arrived);
  ~FleetRouter();
  /// One more vehicle; returns its number, for send(). `key` must outlive the router.
  std::size_t add_vehicle(const std::string& name, bool accept_mavlink1, VehicleKey& key,
                          Received received);
  /// What a vehicle says, to all whom it concerns.
  void send(std::size_t vehicle, const mavlink::Message& message);
  /// Hands over what has come for vehicles.
  void deliver();
  /// Forgets who is silent; about once a second.
  void update();

 private:
  struct Vehicle;
  void hand_out(mavlink::RouterPeer peer, Bytes packet);
  SimTime now() const;

  PollLoop& loop_;
  std::function<void()> arrived_;
  std::unique_ptr<Endpoint> endpoint_;
  std::set<PeerId> clients_;
  std::vector<std::unique_ptr<Vehicle>> vehicles_;
  struct Waiting {
    std::size_t vehicle;
    std::vector<std::uint8_t> packet;
  };
  std::deque<Waiting> waiting_;
  bool is_of_vehicle_ = false;  ///< what is handed out
  mavlink::Router router_;
};

}  // namespace trident::bridges
