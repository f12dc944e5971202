// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <memory>
#include <string>
#include <vector>

#include "trident_bridges_ros/mavlink/fleet_router.h"
#include "trident_bridges_ros/mavlink/fleet_vehicle.h"
#include "trident_bridges_ros/mavlink/lockstep_source.h"
#include "trident_bridges_ros/mavlink/mavlink_node_params.h"
#include "trident_bridges_ros/mavlink/static_frames.h"
#include "trident_bridges_ros/node_poll_loop.h"
#include "trident_ros/refusals.h"

namespace trident::bridges {

/// All vehicles of a file, each an autopilot that speaks MAVLink: it flies by its vehicle's
/// odometry and gives set-points to its controllers, in simulated time. In lockstep the world waits
/// for these set-points, so that runs repeat until a client commands something.
class MavlinkFleetNode {
 public:
  /// Reads the file, subscribes, opens all ports. `loop` must outlive it. Throws Error naming what
  /// is wrong with the file or with a port.
  MavlinkFleetNode(ros::NodeHandle& node, NodePollLoop& loop, const MavlinkNodeParams& params);
  ~MavlinkFleetNode();

 private:
  void look_around();
  bool is_all_connected() const;
  void enroll();
  void note_commanded(const std::string& text);

  MavlinkNodeParams params_;
  NodePollLoop& loop_;
  ros::NodeHandle rare_;
  ros_utils::Refusals refusals_;
  ros::Publisher not_repeatable_;
  StaticFrames frames_;
  std::unique_ptr<ros_utils::DirectSubscription> transforms_;
  std::unique_ptr<FleetRouter> router_;
  std::unique_ptr<FleetParts> parts_;
  std::vector<std::unique_ptr<FleetVehicle>> vehicles_;
  std::unique_ptr<LockstepSource> source_;
  std::uint64_t next_look_ = 0;
};

}  // namespace trident::bridges
