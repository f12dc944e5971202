// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>

#include "control/scene.h"
#include "pain.h"
#include "trident_base/yaml_config.h"
#include "trident_nav/core/footprint.h"

namespace trident::nav::pains {
namespace {

using testing::Drive;
using testing::Scene;

struct NamedRobot {
  const char* name;
  ControlSetup setup;
};

/// From a robot for desks to one for halls, by limits and footprint alone.
ControlSetup large_robot() {
  ControlSetup setup;
  setup.limits = {1.5, -0.5, 0.0, 1.0, 0.8, 1.0, 0.0, 1.5, 0.0};
  setup.footprint = polygon_footprint({{-0.6, -0.4}, {0.6, -0.4}, {0.6, 0.4}, {-0.6, 0.4}});
  return setup;
}

std::vector<NamedRobot> robots() {
  return {{"burger", testing::burger()},
          {"jackal", testing::jackal()},
          {"car", testing::car()},
          {"omni", testing::omni_robot()},
          {"1.2 x 0.8 m", large_robot()}};
}

/// Accelerating, cruising and braking along a straight line.
double fastest_s(const MotionLimits& limits, double length_m) {
  const double ramp_m =
      0.5 * limits.vx_max * limits.vx_max * (1.0 / limits.ax_max + 1.0 / limits.decel_max);
  if (length_m >= ramp_m) {
    return limits.vx_max / limits.ax_max + limits.vx_max / limits.decel_max +
           (length_m - ramp_m) / limits.vx_max;
  }
  const double top = std::sqrt(2.0 * length_m / (1.0 / limits.ax_max + 1.0 / limits.decel_max));
  return top / limits.ax_max + top / limits.decel_max;
}

/// How often the direction of the turn changes, beyond a tenth of what the robot can, per second.
double turn_changes_per_s(const Drive& drive, const MotionLimits& limits) {
  int changes = 0;
  double last = 0.0;
  for (const Twist2& twist : drive.commands) {
    if (std::fabs(twist.wz) < 0.1 * limits.wz_max) continue;
    changes += last * twist.wz < 0.0 ? 1 : 0;
    last = twist.wz;
  }
  return changes / std::max(drive.time_s, 1e-9);
}

/// What the drives of all robots came to at worst.
void raise(double value, const char* robot, Pain* pain) {
  if (value <= pain->measured) return;
  pain->measured = value;
  pain->note = robot;
}

std::string failure_text(const NamedRobot& robot, const Scene& scene, const Drive& drive) {
  if (drive.is_reached && !drive.has_contact) return "";
  return std::string(robot.name) + ", " + scene.name +
         (drive.has_contact ? ": contact. " : ": not reached: " + drive.last_reason + " ");
}

Drive drive_by_default(const NamedRobot& robot, const Scene& scene) {
  const auto controller = make_controller("mppi", robot.setup, parse_yaml("{}", "scene"), "scene");
  return testing::drive(*controller, robot.setup, scene, 90.0);
}

}  // namespace

Pains tuning_pains(bool is_quick) {
  Pain reached{"P6",
               "navigation2#5531, #5714",
               "MPPI without parameters, 5 robots, corner, door and dead end: drives that fail",
               0.0,
               0.0,
               "drives",
               false,
               ""};
  Pain slow{"P6",
            "navigation2#5375, #4354",
            "the same on a straight line: time over the least possible",
            0.0,
            1.25,
            "1",
            false,
            ""};
  Pain wobble{
      "P6", "navigation2#4049", "the same: changes of the turn's direction", 0.0, 1.0, "1/s", false,
      ""};
  Pain overshoot{"P6",
                 "navigation2#6160",
                 "the same: error at the goal over the tolerance",
                 0.0,
                 1.0,
                 "1",
                 false,
                 ""};
  for (const NamedRobot& robot : robots()) {
    const Footprint& footprint = robot.setup.footprint;
    const Scene straight = testing::straight_scene(footprint);
    const Drive line = drive_by_default(robot, straight);
    const double length_m =
        straight.goal.x - straight.start.x - robot.setup.tolerance.xy_goal_tolerance;
    raise(line.time_s / fastest_s(robot.setup.limits, length_m), robot.name, &slow);
    raise(turn_changes_per_s(line, robot.setup.limits), robot.name, &wobble);
    raise(line.position_error_m / robot.setup.tolerance.xy_goal_tolerance, robot.name, &overshoot);
    std::vector<Scene> scenes{straight};
    if (!is_quick) {
      scenes.push_back(testing::corner_scene(footprint));
      scenes.push_back(testing::doorway_scene(footprint));
      if (robot.setup.can_turn_on_spot()) scenes.push_back(testing::dead_end_scene(footprint));
    }
    for (const Scene& scene : scenes) {
      const std::string failure = failure_text(robot, scene, drive_by_default(robot, scene));
      reached.measured += failure.empty() ? 0.0 : 1.0;
      reached.note += failure;
    }
  }
  return {reached, slow, wobble, overshoot};
}

}  // namespace trident::nav::pains
