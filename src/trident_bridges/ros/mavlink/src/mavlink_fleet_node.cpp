// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/mavlink/mavlink_fleet_node.h"

#include <std_msgs/String.h>

#include <algorithm>

#include "trident_base/error.h"
#include "trident_base/yaml_config.h"
#include "trident_bridges_ros/utc.h"

namespace trident::bridges {
namespace {

constexpr double kLookEvery_s = 0.1;  // wall time

}  // namespace

MavlinkFleetNode::MavlinkFleetNode(ros::NodeHandle& node, NodePollLoop& loop,
                                   const MavlinkNodeParams& params)
    : params_(params),
      loop_(loop),
      rare_(loop.served(ros::NodeHandle())),
      refusals_(rare_),
      not_repeatable_(rare_.advertise<std_msgs::String>("/gazebo/not_repeatable", 10, true)),
      frames_(params.world_frame) {
  const auto file = load_yaml<mavlink::VehiclesFile>(params.vehicles_file);
  if (file.vehicles.empty()) {
    throw Error(params.vehicles_file + ": vehicles: [], legal: one entry or more");
  }
  transforms_ = loop.subscribe<tf2_msgs::TFMessage>(
      node, "/tf_static", 100, [this](const tf2_msgs::TFMessage& message) {
        const std::string problem = frames_.add(message);
        if (!problem.empty())
          refusals_.note("/tf_static refused", "/tf_static refused: " + problem);
      });
  router_ = std::make_unique<FleetRouter>(FleetRouter::Setup{file.router_port, params.allow_remote},
                                          loop.loop(), [this] { router_->deliver(); });
  parts_ = std::make_unique<FleetParts>(
      FleetParts{params_, file.gcs_remote_port, read_utc_start(), loop, frames_, refusals_,
                 *router_, [this](const std::string& text) { note_commanded(text); }});
  for (const mavlink::VehicleLinks& links : mavlink::resolve(file)) {
    vehicles_.push_back(std::make_unique<FleetVehicle>(links, *parts_));
  }
  loop.follow_clock(node, [this](const ros::Time& now) {
    const SimTime simulated{static_cast<std::int64_t>(now.toNSec())};
    for (const auto& vehicle : vehicles_) vehicle->update(simulated);
  });
  ROS_INFO("%zu vehicle(s) speak MAVLink; all of them at TCP port %d", vehicles_.size(),
           int{file.router_port});
  look_around();
}

MavlinkFleetNode::~MavlinkFleetNode() { loop_.loop().cancel(next_look_); }

void MavlinkFleetNode::look_around() {
  next_look_ = loop_.loop().call_after(kLookEvery_s, [this] { look_around(); });
  router_->deliver();
  router_->update();
  if (params_.lockstep && !source_ && is_all_connected()) enroll();
  for (const auto& vehicle : vehicles_) vehicle->repeat();
}

bool MavlinkFleetNode::is_all_connected() const {
  return std::all_of(vehicles_.begin(), vehicles_.end(),
                     [](const auto& vehicle) { return vehicle->is_connected(); });
}

void MavlinkFleetNode::enroll() {
  LockstepSource::Setup setup;
  setup.period_s = params_.period_s;
  for (const auto& vehicle : vehicles_) {
    if (vehicle->is_stamped()) setup.vehicles.push_back(vehicle->name());
  }
  if (setup.vehicles.empty()) {
    params_.lockstep = false;
    return;
  }
  source_ = std::make_unique<LockstepSource>(setup, loop_.loop(), [this](SimTime start) {
    for (const auto& vehicle : vehicles_) vehicle->begin_lockstep(start);
  });
}

void MavlinkFleetNode::note_commanded(const std::string& text) {
  ROS_INFO("%s", text.c_str());
  std_msgs::String message;
  message.data = text;
  not_repeatable_.publish(message);
}

}  // namespace trident::bridges
