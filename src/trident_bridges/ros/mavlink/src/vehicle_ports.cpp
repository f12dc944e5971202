// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/mavlink/vehicle_ports.h"

#include <ros/console.h>
#include <ros/time.h>

#include <utility>

#include "trident_base/error.h"

namespace trident::bridges {
namespace {

/// [bytes] of a datagram: as much as a frame of Ethernet takes.
constexpr std::size_t kFullDatagram = 1400;

mavlink::SigningTime signing_now() {
  return mavlink::signing_time(static_cast<std::int64_t>(ros::WallTime::now().toNSec()));
}

}  // namespace

VehicleKey::VehicleKey(const std::string& file) {
  if (file.empty()) return;
  store_ = std::make_unique<mavlink::SigningFile>(file + ".times");
  signing_ = std::make_unique<mavlink::Signing>(mavlink::read_signing_key(file), store_.get(),
                                                signing_now());
}

mavlink::PacketSigner* VehicleKey::signer(std::uint8_t link) {
  if (!signing_) return nullptr;
  signers_.push_back(std::make_unique<mavlink::PacketSigner>(*signing_, link));
  return signers_.back().get();
}

std::string VehicleKey::refusal(const mavlink::Packet& packet) {
  if (!signing_) return "";
  signing_->advance(signing_now());
  const auto verdict = signing_->check(packet);
  return verdict == mavlink::SignatureVerdict::kAccepted ? "" : mavlink::text_of(verdict);
}

struct VehiclePorts::Port {
  explicit Port(mavlink::PacketSigner* signer) : writer(signer) {}
  std::unique_ptr<Endpoint> endpoint;
  mavlink::PacketWriter writer;
  struct Peer {
    std::string address;
    mavlink::PacketParser parser;
  };
  std::map<PeerId, Peer> peers;
  bool has_datagrams = false;
  std::vector<std::uint8_t> waiting;  // whole packets
};

VehiclePorts::VehiclePorts(const mavlink::VehicleLinks& links, Setup setup, VehicleKey& key,
                           PollLoop& loop)
    : vehicle_(links.vehicle),
      accept_mavlink1_(links.accept_mavlink1),
      setup_(std::move(setup)),
      key_(key) {
  const std::string host = setup_.allow_remote ? "0.0.0.0" : "127.0.0.1";
  const auto udp = [&](std::uint16_t local, std::uint16_t remote) {
    open("udp://" + host + ":" + std::to_string(local) + "@127.0.0.1:" + std::to_string(remote),
         true, loop);
  };
  udp(links.offboard_port, links.offboard_remote_port);
  udp(links.gcs_port, setup_.gcs_remote_port);
  open("tcp-l://" + host + ":" + std::to_string(links.tcp_port), false, loop);
}

VehiclePorts::~VehiclePorts() = default;

void VehiclePorts::open(const std::string& url, bool has_datagrams, PollLoop& loop) {
  const auto link = static_cast<std::uint8_t>(ports_.size());
  ports_.push_back(std::make_unique<Port>(key_.signer(link)));
  Port& port = *ports_.back();
  port.has_datagrams = has_datagrams;
  port.waiting.reserve(kFullDatagram);
  EndpointEvents events;
  events.joined = [this, &port](PeerId peer, const std::string& address) {
    port.peers.emplace(peer, Port::Peer{address, mavlink::PacketParser(accept_mavlink1_)});
    ROS_INFO("%s: %s is there", vehicle_.c_str(), address.c_str());
  };
  events.left = [this, &port](PeerId peer, const std::string& reason) {
    port.peers.erase(peer);
    ROS_INFO("%s: a client is gone: %s", vehicle_.c_str(), reason.c_str());
  };
  events.received = [this, &port](PeerId peer, Bytes bytes) { receive(port, peer, bytes); };
  events.warning = [](const std::string& text) { ROS_WARN("%s", text.c_str()); };
  events.notice = [](const std::string& text) { ROS_DEBUG("%s", text.c_str()); };
  EndpointOptions options;
  options.url = url;
  options.allow_remote = setup_.allow_remote;
  try {
    port.endpoint = open_endpoint(options, loop, std::move(events));
  } catch (const Error& error) {
    throw Error("vehicle '" + vehicle_ + "': " + error.what());
  }
}

void VehiclePorts::send(const mavlink::Message& message) {
  for (const auto& port : ports_) {
    if (port->peers.empty()) continue;
    const Bytes packet = port->writer.write(message);
    if (port->waiting.size() + packet.size() > kFullDatagram) flush(*port);
    port->waiting.insert(port->waiting.end(), packet.begin(), packet.end());
    has_waiting_ = true;
  }
}

void VehiclePorts::flush() {
  if (!has_waiting_) return;
  has_waiting_ = false;
  for (const auto& port : ports_) flush(*port);
}

void VehiclePorts::flush(Port& port) {
  if (port.waiting.empty()) return;
  port.endpoint->send_to_all(Bytes(port.waiting));
  port.waiting.clear();
}

void VehiclePorts::receive(Port& port, PeerId id, Bytes bytes) {
  const auto peer = port.peers.find(id);
  if (peer == port.peers.end()) return;
  mavlink::PacketParser& parser = peer->second.parser;
  port.has_datagrams ? parser.feed_datagram(bytes) : parser.feed(bytes);
  const std::string from = port.endpoint->name() + " from " + peer->second.address;
  while (const auto packet = parser.next()) {
    const std::string refusal = key_.refusal(*packet);
    if (refusal.empty()) {
      setup_.received(mavlink::to_message(*packet), from);
    } else {
      setup_.refused(refusal, vehicle_ + ": packet refused at " + from + ": " + refusal);
    }
  }
}

}  // namespace trident::bridges
