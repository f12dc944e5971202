// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <memory>
#include <string>

#include "trident_base/se3.h"
#include "trident_base/sim_time.h"
#include "trident_bridges/autopilot/vehicle.h"
#include "trident_bridges/mavlink/vehicles.h"

namespace trident::bridges {

/// Where a set-point comes from, and for which frame.
struct SetpointContext {
  const VehicleState& state;  ///< by which it was made, world
  SimTime stamp;              ///< when it counts
  const std::string& frame;   ///< of the controller's odometry
  const SE3& T_world_frame;   ///< takes coordinates of that frame to the world
};

/// Gives an autopilot's set-points to the controllers of one vehicle.
class SetpointOutput {
 public:
  virtual ~SetpointOutput() = default;
  /// Publishes one set-point.
  virtual void publish(const Setpoint& setpoint, const SetpointContext& context) = 0;
  /// Whether a controller listens to all that may be published.
  virtual bool has_reader() const = 0;
  /// Whether set-points count by their stamps, so that a world can wait for them. Those of others
  /// are answers to odometry, one to each.
  virtual bool is_stamped() const = 0;
};

/// For a vehicle below `node`: multirotors `command/trajectory`, `command/attitude_thrust`,
/// `command/rate_thrust`, `command/stop`; rovers `cmd_vel`; boats `command/path`,
/// `command/cruise`, `command/velocity`, `command/pose`, `command/stop`.
std::unique_ptr<SetpointOutput> make_setpoint_output(ros::NodeHandle& node,
                                                     mavlink::VehicleKind kind,
                                                     double max_thrust_N);

}  // namespace trident::bridges
