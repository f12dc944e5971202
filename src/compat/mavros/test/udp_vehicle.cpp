// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// A vehicle that obeys its autopilot, behind UDP, by the wall's clock: what mavros_node is tested
// with. Arguments: kind (px4 or ardupilot), URL, filling of the battery.
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <string>

#include "autopilot/obedient_body.h"
#include "trident_base/error.h"
#include "trident_bridges/mavlink/packet_parser.h"
#include "trident_bridges/mavlink/packet_writer.h"
#include "trident_bridges/transport/endpoint.h"
#include "trident_bridges/transport/epoll_loop.h"
#include "trident_bridges/vehicle/mavlink_vehicle.h"

namespace trident::bridges {
namespace {

constexpr double kStep_s = 0.02;

class UdpVehicle {
 public:
  UdpVehicle(mavlink::AutopilotFlavour flavour, const std::string& url, double battery)
      : vehicle_(options_of(flavour), [this](const mavlink::Message& message) { send(message); }) {
    state_.battery = battery;
    EndpointOptions options;
    options.url = url;
    EndpointEvents events;
    events.received = [this](PeerId, Bytes bytes) { receive(bytes); };
    endpoint_ = open_endpoint(options, loop_, events);
    step();
  }

  void run() { loop_.run(); }

 private:
  static mavlink::MavlinkVehicleOptions options_of(mavlink::AutopilotFlavour flavour) {
    mavlink::MavlinkVehicleOptions options;
    options.flavour = flavour;
    options.origin = {47.397742, 8.545594, 488.0};
    return options;
  }
  mavlink::BothTimes now() const {
    const SimTime wall = SimTime::from_seconds(loop_.now_s() - begun_s_);
    return {wall, wall};
  }
  void send(const mavlink::Message& message) {
    if (endpoint_) endpoint_->send_to_all(writer_.write(message));
  }
  void receive(Bytes bytes) {
    parser_.feed_datagram(bytes);
    while (const auto packet = parser_.next()) {
      vehicle_.handle(mavlink::to_message(*packet), now());
    }
  }
  void step() {
    loop_.call_after(kStep_s, [this] { step(); });
    state_.position_stamp = now().simulated;
    vehicle_.update(now());
    const Setpoint setpoint = vehicle_.step(now().simulated, state_);
    obey(setpoint, kStep_s, state_);
  }

  EpollLoop loop_;
  double begun_s_ = loop_.now_s();
  VehicleState state_;
  mavlink::PacketParser parser_;
  mavlink::PacketWriter writer_;
  mavlink::MavlinkVehicle vehicle_;
  std::unique_ptr<Endpoint> endpoint_;
};

}  // namespace
}  // namespace trident::bridges

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  using trident::bridges::mavlink::AutopilotFlavour;
  try {
    const auto flavour =
        std::string(argv[1]) == "px4" ? AutopilotFlavour::kPx4 : AutopilotFlavour::kArdupilot;
    trident::bridges::UdpVehicle vehicle(flavour, argv[2], std::stod(argv[3]));
    std::cout << "the vehicle is up" << std::endl;  // the test waits for it
    vehicle.run();
  } catch (const trident::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
