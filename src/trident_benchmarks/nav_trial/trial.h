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

/// What came of one run.
struct TrialResult {
  TrialEnd end = TrialEnd::kTimeout;
  double time_s = 0.0;                  ///< Since the robot had moved by `moved_m`.
  std::string text;                     ///< What was touched, or why the goal was given up.
  std::vector<std::string> recoveries;  ///< Names and causes.
  std::vector<nav::Pose2> track;        ///< By the truth, in the world.
  double odometry_error_m = 0.0;        ///< At the end.
  double top_speed_m_s = 0.0;
  double navigation_cpu_s = 0.0;  ///< Of costmaps, planner and controller.
};

/// Drives one robot to one goal. Equal configurations and seeds give equal results to the bit, but
/// for the CPU time. Throws Error.
TrialResult run_trial(const TrialConfig& config, const ConfigNode& parameters, std::uint64_t seed);

}  // namespace trident::benchmarks
