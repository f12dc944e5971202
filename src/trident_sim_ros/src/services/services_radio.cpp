// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <trident_msgs/SetOutage.h>

#include "services.h"
#include "trident_base/error.h"
#include "trident_sim/comms/radio.h"

namespace trident::sim {
namespace {

using trident_msgs::SetOutage;

void set_outage(Simulation& simulation, const SetOutage::Request& request) {
  Simulation::Access access(simulation);
  const auto radio = find_radio(access.world());
  if (radio == nullptr) throw Error("the world has no radios");
  if (request.length < ros::Duration(0)) {
    throw Error("length is " + std::to_string(request.length.toSec()) + " s, legal: >= 0");
  }
  World& world = access.changed_by("/radio/outage");
  radio->set_outage(request.source, request.destination, world.time() + from_ros(request.length));
}

}  // namespace

void advertise_radio_service(ros::NodeHandle& node, Simulation& simulation, Servers& servers) {
  const auto answer = [&simulation](SetOutage::Request& request, SetOutage::Response& response) {
    try {
      set_outage(simulation, request);
      response.success = true;
    } catch (const std::exception& error) {
      response.message = one_line(std::string("SetOutage: ") + error.what());
      ROS_ERROR("%s", response.message.c_str());
    }
    return true;
  };
  servers.push_back(
      node.advertiseService<SetOutage::Request, SetOutage::Response>("/radio/outage", answer));
}

}  // namespace trident::sim
