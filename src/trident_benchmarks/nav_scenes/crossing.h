// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trial_config.h"
#include "trident_base/config_node.h"
#include "trident_nav/control/robot_state.h"
#include "walkers.h"

namespace trident::benchmarks {

/// A drive through a hall in which people walk, by a robot that knows its pose.
struct CrossingConfig {
  TrialConfig trial;
  WalkerParams walkers;
  double frame_period_s = 0.0;

  template <class Archive>
  void visit(Archive& ar) {
    ar.required("trial", trial, "the hall, the robot, its start and goal");
    ar.field("walkers", walkers, "who walks in it");
    ar.field("frame_period_s", frame_period_s, Range::non_negative(),
             "between records of all that moves; 0: none [s]");
  }
};

/// One touch of robot and walker, from the first moment until they were apart for a while.
struct Touch {
  double time_s = 0.0;  ///< Of the first moment.
  std::size_t walker = 0;
  /// Of the point of the robot that touches, towards the walker, before the first moment [m/s].
  double own_speed_m_s = 0.0;
  double last_s = 0.0;     ///< Of the latest moment.
  bool is_pushed = false;  ///< Somebody else pushed the robot then, or half a second before.
};

/// All that moves at one moment, in the frame of the world.
struct CrossingFrame {
  double time_s = 0.0;
  nav::Pose2 robot;
  nav::Twist2 command;
  std::vector<nav::Point2> walkers;
  nav::Tracks tracks;  ///< As the navigation has them.
};

/// What came of a crossing.
struct CrossingResult {
  bool has_arrived = false;
  double time_s = 0.0;  ///< From the goal's coming to the end.
  std::string text;     ///< Of the end.
  std::vector<Touch> touches;
  std::string wall;  ///< What else was touched first; empty: nothing.
  int recoveries = 0;
  double navigation_cpu_s = 0.0;
  std::vector<CrossingFrame> frames;
};

/// Drives once through the hall. Equal configurations and seeds give equal results to the bit, but
/// for the CPU time. Throws Error.
CrossingResult run_crossing(const CrossingConfig& config, const ConfigNode& parameters,
                            std::uint64_t seed);

}  // namespace trident::benchmarks
