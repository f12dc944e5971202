// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/mavlink/fleet_router.h"

#include <ros/console.h>

#include <utility>

#include "trident_base/error.h"
#include "trident_bridges_ros/mavlink/vehicle_ports.h"

namespace trident::bridges {
namespace {

constexpr mavlink::RouterPeer kFirstClient = 1000;  // below: vehicles
constexpr std::uint8_t kLink = 100;                 // of signatures; ports of a vehicle are below
constexpr std::uint32_t kHeartbeat = 0;             // id of HEARTBEAT

mavlink::RouterOptions router_options() {
  mavlink::RouterOptions options;
  options.max_peers = 254 + 16;
  options.max_rate_hz = 1e6;  // simulated vehicles are as fast as the simulation
  return options;
}

}  // namespace

struct FleetRouter::Vehicle {
  Vehicle(bool accept_mavlink1, VehicleKey& its_key)
      : key(its_key), parser(accept_mavlink1), writer(its_key.signer(kLink)) {}
  VehicleKey& key;
  mavlink::PacketParser parser;
  mavlink::PacketWriter writer;
  Received received;
};

FleetRouter::FleetRouter(const Setup& setup, PollLoop& loop, std::function<void()> arrived)
    : loop_(loop),
      arrived_(std::move(arrived)),
      router_(
          router_options(),
          [this](mavlink::RouterPeer peer, Bytes packet) { hand_out(peer, packet); },
          [](const std::string& text) { ROS_WARN("%s", text.c_str()); }) {
  EndpointEvents events;
  events.joined = [this](PeerId peer, const std::string& address) {
    if (router_.add_peer(kFirstClient + peer, address)) clients_.insert(peer);
    ROS_INFO("router: %s is there", address.c_str());
  };
  events.left = [this](PeerId peer, const std::string& reason) {
    router_.remove_peer(kFirstClient + peer);
    clients_.erase(peer);
    ROS_INFO("router: a client is gone: %s", reason.c_str());
  };
  events.received = [this](PeerId peer, Bytes bytes) {
    router_.receive(kFirstClient + peer, bytes, false, now());
    if (!waiting_.empty()) arrived_();
  };
  events.warning = [](const std::string& text) { ROS_WARN("%s", text.c_str()); };
  EndpointOptions options;
  options.url = std::string("tcp-l://") + (setup.allow_remote ? "0.0.0.0" : "127.0.0.1") + ":" +
                std::to_string(setup.port);
  options.allow_remote = setup.allow_remote;
  try {
    endpoint_ = open_endpoint(options, loop, std::move(events));
  } catch (const Error& error) {
    throw Error(std::string("the router: ") + error.what());
  }
}

FleetRouter::~FleetRouter() = default;

SimTime FleetRouter::now() const { return SimTime::from_seconds(loop_.now_s()); }

std::size_t FleetRouter::add_vehicle(const std::string& name, bool accept_mavlink1, VehicleKey& key,
                                     Received received) {
  vehicles_.push_back(std::make_unique<Vehicle>(accept_mavlink1, key));
  vehicles_.back()->received = std::move(received);
  const std::size_t number = vehicles_.size() - 1;
  router_.add_peer(static_cast<mavlink::RouterPeer>(number), name);
  return number;
}

/// With nobody there only heartbeats pass, by which it knows where each system is.
void FleetRouter::send(std::size_t vehicle, const mavlink::Message& message) {
  if (clients_.empty() && message.id != kHeartbeat) return;
  const Bytes packet = vehicles_[vehicle]->writer.write(message);
  is_of_vehicle_ = true;
  router_.receive(static_cast<mavlink::RouterPeer>(vehicle), packet, true, now());
  is_of_vehicle_ = false;
}

void FleetRouter::hand_out(mavlink::RouterPeer peer, Bytes packet) {
  if (peer >= kFirstClient) {
    endpoint_->send(peer - kFirstClient, packet);
    return;
  }
  if (is_of_vehicle_) return;  // vehicles say nothing to each other
  waiting_.push_back({peer, {packet.begin(), packet.end()}});
}

void FleetRouter::deliver() {
  while (!waiting_.empty()) {
    const Waiting next = std::move(waiting_.front());
    waiting_.pop_front();
    Vehicle& vehicle = *vehicles_[next.vehicle];
    vehicle.parser.feed_datagram(Bytes(next.packet.data(), next.packet.size()));
    while (const auto packet = vehicle.parser.next()) {
      if (vehicle.key.refusal(*packet).empty()) {
        vehicle.received(mavlink::to_message(*packet), "the router");
      }
    }
  }
}

void FleetRouter::update() { router_.update(now()); }

}  // namespace trident::bridges
