// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "trident_base/sim_time.h"

namespace trident::sim {

/// Waypoints to follow (nav_msgs/Path). `stamp`: from when on; 0: at once.
struct PathCommand {
  SimTime stamp;                         ///< see above
  std::vector<Eigen::Vector3d> p_world;  ///< [m]
};

/// Something that is to be done once, a picture to be taken say (std_msgs/Empty on a topic).
struct TriggerCommand {
  SimTime stamp;  ///< not looked at: it acts in the next step
};

/// The same, asked for by a service without arguments (std_srvs/Empty).
struct ServiceCommand {
  SimTime stamp;  ///< not looked at: it acts in the next step
};

/// A number on a topic of single precision (std_msgs/Float32), as VRX has those of its thrusters.
struct SingleNumber {
  SimTime stamp;
  double value = 0.0;  ///< part of full thrust or an angle, as the plugin documents
};

/// A number with its time on a topic of uuv_simulator (uuv_gazebo_ros_plugins_msgs/FloatStamped);
/// in or out.
struct StampedNumber {
  SimTime stamp;       ///< of a measurement; a command's is not looked at
  double value = 0.0;  ///< in the unit that the plugin documents
};

/// Of a boat with two propellers, as heron_msgs/Drive: parts of full thrust.
struct DriveCommand {
  SimTime stamp;                   ///< not looked at: it acts in the next step
  double left = 0.0, right = 0.0;  ///< [-1, 1]
};

/// Of joints or thrusters by name, as sensor_msgs/JointState; what is not given is empty.
struct JointCommand {
  SimTime stamp;                                       ///< not looked at: it acts in the next step
  std::vector<std::string> names;                      ///< of joints or thrusters of one model
  std::vector<double> positions, velocities, efforts;  ///< parallel to `names`, or empty
};

}  // namespace trident::sim
