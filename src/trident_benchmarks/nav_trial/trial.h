// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trial_config.h"
#include "trident_base/config_node.h"
#include "trident_nav/core/geometry.h"

namespace trident::benchmarks {

/// How a run ended.
enum class TrialEnd { kReached, kCollided, kTimeout, kAborted };
/// "reached", "collided", "timeout", "aborted".
std::string name_of(TrialEnd end);

/// What came of one goal of a run.
struct GoalResult {
  nav::Pose2 goal;  ///< In the world.
  TrialEnd end = TrialEnd::kTimeout;
  std::string text;     ///< Why the goal was given up, or what move_base says.
  double time_s = 0.0;  ///< Since the goal was given.
  double position_error_m = 0.0, heading_error_rad = 0.0;  ///< By the truth, at the end.
  std::string touched;  ///< What was touched first; empty: nothing.
  std::size_t recoveries = 0;
};

/// What came of one run.
struct TrialResult {
  TrialEnd end = TrialEnd::kTimeout;    ///< Of the last goal.
  std::vector<GoalResult> goals;        ///< Those that were tried.
  double time_s = 0.0;                  ///< Since the robot had moved by `moved_m`.
  std::string text;                     ///< What was touched, or why the goal was given up.
  std::vector<std::string> recoveries;  ///< Names and causes.
  std::vector<nav::Pose2> track;        ///< By the truth, in the world.
  double odometry_error_m = 0.0;        ///< At the end.
  double localization_error_m = 0.0;    ///< The greatest one at the end of a goal; with a map.
  double top_speed_m_s = 0.0, least_speed_m_s = 0.0;  ///< By odometry, along the robot.
  double navigation_cpu_s = 0.0;                      ///< Of costmaps, planner and controller.
};

/// Drives one robot to its goals, one after the other. Equal configurations and seeds give equal
/// results to the bit, but for the CPU time. Throws Error.
TrialResult run_trial(const TrialConfig& config, const ConfigNode& parameters, std::uint64_t seed);

}  // namespace trident::benchmarks
