// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "planning/curves/curve_checker.h"
#include "planning/curves/motion_set.h"
#include "planning/poses/state_set.h"

namespace trident::nav {

/// Whether a goal can be entered at its heading at all: looks backwards along the motions that end
/// there. Most goals at which a robot fits but that it cannot drive to are found out at once, where
/// a search from the start would first come to all that it can reach.
class GoalProbe {
 public:
  explicit GoalProbe(const MotionSet& motions);

  /// False when all chains of motions that end at the goal are short and begin in contact. Pose in
  /// cells.
  bool can_enter(const CurveChecker& checker, const Pose2& goal);

 private:
  struct Node {
    double x, y;
    std::uint16_t heading;
  };
  void expand(const CurveChecker& checker, const Node& node);

  const MotionSet& motions_;
  std::vector<std::vector<std::uint32_t>> by_end_;  ///< Motions by the heading at their end.
  StateSet seen_;
  std::vector<Node> open_;
  double offset_ = 0.0, cos_ = 1.0, sin_ = 0.0;
};

}  // namespace trident::nav
