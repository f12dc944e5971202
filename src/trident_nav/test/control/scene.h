// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "control/grid_world.h"
#include "trident_nav/control/controller.h"

namespace trident::nav::testing {

/// A robot in a world that has somewhere to go.
struct Scene {
  std::string name;
  GridWorld world;
  Pose2 start;
  Pose2 goal;
};

/// The scenes, sized for a footprint: corridors and doors are as wide as it needs.
Scene straight_scene(const Footprint& footprint);
Scene corner_scene(const Footprint& footprint);
Scene doorway_scene(const Footprint& footprint);
Scene dead_end_scene(const Footprint& footprint);
Scene goal_behind_scene(const Footprint& footprint);

/// What a drive has come to.
struct Drive {
  bool is_reached = false;  ///< By the controller's own word.
  bool has_contact = false;
  double time_s = 0.0;
  double position_error_m = 0.0;
  double heading_error_rad = 0.0;
  double max_acceleration_ratio = 0.0;  ///< Of the commands' changes to what the limits allow.
  int failures = 0;                     ///< Calls without a command.
  std::string last_reason;
  Path track;
  std::vector<Twist2> commands;
};

/// Whether two commands are equal bit by bit.
bool are_equal(const Twist2& a, const Twist2& b);
/// Whether all commands of two drives are.
bool are_equal(const Drive& a, const Drive& b);

/// One period of a plant whose velocities follow the command at the limits. False: contact.
bool follow_command(const ControlSetup& setup, const FootprintChecker& body, const CostGrid& grid,
                    const Twist2& command, RobotState* state);

/// Drives a scene with a robot that follows commands at its limits of acceleration, exactly. Stops
/// at contact, arrival or the time limit. `late_periods`: by which its odometry lags behind.
Drive drive(Controller& controller, const ControlSetup& setup, const Scene& scene,
            double limit_s = 60.0, const Path& path = {}, std::size_t late_periods = 0);

/// Robots with limits and footprints like those that users have.
ControlSetup burger();
ControlSetup jackal();
ControlSetup car();
ControlSetup omni_robot();

}  // namespace trident::nav::testing
