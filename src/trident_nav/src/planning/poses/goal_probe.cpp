// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/poses/goal_probe.h"

#include <algorithm>
#include <cmath>

namespace trident::nav {
namespace {

/// Poses from which the goal can be reached are enough when their motions, end to end, are as long
/// as this many cells, and when there are so many.
constexpr double kEnoughCells = 800.0;
constexpr double kMinPoses = 40.0;

}  // namespace

GoalProbe::GoalProbe(const MotionSet& motions)
    : motions_(motions), by_end_(motions.heading_count()) {
  for (std::uint32_t i = 0; i < motions.primitives().size(); ++i) {
    by_end_[motions.primitives()[i].end_heading].push_back(i);
  }
}

bool GoalProbe::can_enter(const CurveChecker& checker, const Pose2& goal) {
  const std::size_t heading = motions_.nearest_heading(goal.yaw);
  offset_ = goal.yaw - motions_.heading(heading);
  cos_ = std::cos(offset_);
  sin_ = std::sin(offset_);
  seen_.reset(checker.grid().geometry, motions_.heading_count());
  open_.assign(1, {goal.x, goal.y, static_cast<std::uint16_t>(heading)});
  const double enough = std::max(kMinPoses, kEnoughCells / std::max(1.0, motions_.longest()));
  for (int count = 0; !open_.empty(); ++count) {
    if (count >= enough) return true;
    const Node node = open_.back();
    open_.pop_back();
    expand(checker, node);
  }
  return false;
}

void GoalProbe::expand(const CurveChecker& checker, const Node& node) {
  const GridGeometry& geometry = checker.grid().geometry;
  for (const std::uint32_t i : by_end_[node.heading]) {
    const Primitive& p = motions_.primitives()[i];
    const Node from{node.x - (cos_ * p.dx - sin_ * p.dy), node.y - (sin_ * p.dx + cos_ * p.dy),
                    p.start_heading};
    const Cell cell{static_cast<int>(std::floor(from.x)), static_cast<int>(std::floor(from.y))};
    if (!geometry.contains(cell) || seen_.contains(cell.x, cell.y, from.heading)) continue;
    const Pose2 pose{from.x, from.y, motions_.heading(from.heading) + offset_};
    if (!checker.is_free(pose)) continue;
    if (!checker.is_free(pose, motions_.poses(p), p.pose_count, cos_, sin_)) continue;
    seen_.insert(cell.x, cell.y, from.heading);
    open_.push_back(from);
  }
}

}  // namespace trident::nav
