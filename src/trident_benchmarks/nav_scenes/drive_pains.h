// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trial_config.h"
#include "trident_base/config_node.h"

namespace trident::benchmarks {

/// Scenes in which a robot drives in a simulated world.
struct DrivePainConfig {
  TrialConfig trial;
  int goals = 200;

  template <class Archive>
  void visit(Archive& ar) {
    ar.required("trial", trial, "the world, the robot, its start and a goal far ahead");
    ar.field("goals", goals, Range{1, 100000}, "near the robot, one after the other");
  }
};

/// What came of a lidar that falls silent while the robot drives at full speed.
struct Silence {
  double speed_m_s = 0.0;      ///< When it fell silent.
  double stopped_s = 0.0;      ///< From then until the robot stood.
  double traveled_m = 0.0;     ///< Over that time.
  double moved_later_m = 0.0;  ///< While it was silent still.
  std::string waiting;         ///< What the navigation said.
  bool has_continued = false;  ///< The goal was reached after scans came again.
};

/// Drives toward the goal; at full speed the scans stop for some seconds.
Silence fall_silent(const DrivePainConfig& config, const ConfigNode& parameters,
                    std::uint64_t seed);

/// What came of one goal near the robot.
struct NearGoal {
  double distance_m = 0.0, bearing_rad = 0.0, turn_rad = 0.0;  ///< From the pose before.
  bool is_reached = false;
  double time_s = 0.0;
  int recoveries = 0;
  double overshoot_m = 0.0;  ///< By which the robot left the goal's tolerance again, by odometry.
  std::string text;
};

/// Goals 0.05 to 1 m away in any direction and with any heading, one after the other.
std::vector<NearGoal> drive_near_goals(const DrivePainConfig& config, const ConfigNode& parameters,
                                       std::uint64_t seed);

}  // namespace trident::benchmarks
