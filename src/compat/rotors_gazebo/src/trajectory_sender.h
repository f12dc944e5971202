// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>
#include <trajectory_msgs/MultiDOFJointTrajectory.h>

#include <vector>

#include "waypoints.h"

namespace trident::control {

/// One trajectory point per waypoint; time_from_start is the sum of the waits so far.
trajectory_msgs::MultiDOFJointTrajectory trajectory_through(const std::vector<Waypoint>& waypoints);

/// Waits for seconds of ROS time, from the first clock on; when time is set back, from there on
/// again. False when the node was shut down meanwhile.
bool wait_for(double seconds);

/// Sends one trajectory on `command/trajectory` and sees that it arrives: RotorS' examples publish
/// and exit, and lose the message when the controller has not connected yet, as it has not at fifty
/// times real time.
class TrajectorySender {
 public:
  explicit TrajectorySender(ros::NodeHandle& node);

  /// Waits until somebody listens (wall clock), stamps the message, sends it, and waits until it is
  /// out. False when the node was shut down meanwhile.
  bool send(trajectory_msgs::MultiDOFJointTrajectory trajectory);

 private:
  ros::Publisher publisher_;
};

}  // namespace trident::control
