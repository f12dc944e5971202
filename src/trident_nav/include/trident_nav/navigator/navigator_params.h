// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_base/config_types.h"

namespace trident::nav {

/// How a navigator continues when something fails: names and defaults of move_base.
struct NavigatorParams {
  double planner_frequency = 0.0;
  double controller_frequency = 20.0;
  double planner_patience = 5.0;
  double controller_patience = 15.0;
  int max_planning_retries = -1;
  double oscillation_timeout = 0.0;
  double oscillation_distance = 0.5;
  bool recovery_behavior_enabled = true;
  double path_hysteresis = 0.1;
  double commit_time = 2.0;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field(
        "planner_frequency", planner_frequency, Range::non_negative(),
        "of new paths while driving; 0: when there is a new goal, or the path is blocked [Hz]");
    ar.field("controller_frequency", controller_frequency, Range::positive(), "of commands [Hz]");
    ar.field("planner_patience", planner_patience, Range::non_negative(),
             "how long a path is tried for before a recovery [s]");
    ar.field("controller_patience", controller_patience, Range::non_negative(),
             "how long a command is tried for before a recovery [s]");
    ar.field("max_planning_retries", max_planning_retries, Range::at_least(-1.0),
             "failed plans before a recovery; -1: planner_patience alone counts");
    ar.field("oscillation_timeout", oscillation_timeout, Range::non_negative(),
             "time without oscillation_distance before a recovery; 0: no limit [s]");
    ar.field("oscillation_distance", oscillation_distance, Range::non_negative(),
             "how far the robot must get [m]");
    ar.field("recovery_behavior_enabled", recovery_behavior_enabled,
             "recoveries are tried before a goal is given up");
    ar.field("path_hysteresis", path_hysteresis, Range{0.0, 1.0},
             "by how much of its cost a new path must be better than a free old one");
    ar.field("commit_time", commit_time, Range::non_negative(),
             "how long a free path is kept at least [s]");
  }
};

}  // namespace trident::nav
