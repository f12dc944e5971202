// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/navigator/path_keeper.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace trident::nav {
namespace {

double distance_to(const Pose2& a, const Pose2& b) { return distance(a.x, a.y, b.x, b.y); }

}  // namespace

void PathKeeper::clear() {
  path_.clear();
  nearest_ = 0;
}

Path PathKeeper::remaining() const {
  constexpr std::size_t kBehind = 2;  // poses: the robot lies between two of them
  const std::size_t first = nearest_ - std::min(nearest_, kBehind);
  return {path_.begin() + static_cast<std::ptrdiff_t>(first), path_.end()};
}

/// Looks ahead only as far as the path leads away from the robot by no more than this: of a path
/// that comes back, the part that is driven first is kept.
void PathKeeper::advance(const Pose2& robot) {
  constexpr double kLookahead_m = 1.0;
  if (path_.empty()) return;
  double least = distance_to(path_[nearest_], robot), walked = 0.0;
  std::size_t best = nearest_;
  for (std::size_t i = nearest_ + 1; i < path_.size() && walked < kLookahead_m + least; ++i) {
    walked += distance_to(path_[i - 1], path_[i]);
    const double d = distance_to(path_[i], robot);
    if (d > least) continue;
    least = d;
    best = i;
  }
  nearest_ = best;
}

bool PathKeeper::keeps_old(const Path& path, double now_s, const Pose2& robot, double left_m,
                           NavigatorWorld& world) const {
  if (path_.empty() || distance_to(path_[nearest_], robot) > left_m) return false;
  const Pose2 &old_end = path_.back(), &end = path.back();
  if (distance_to(old_end, end) > left_m) return false;  // the old one led elsewhere
  const double old_cost = world.path_cost(path_, nearest_);
  if (!std::isfinite(old_cost)) return false;
  if (now_s - taken_s_ < commit_s_) return true;
  return world.path_cost(path, 0) > (1.0 - hysteresis_) * old_cost;
}

bool PathKeeper::offer(Path path, double now_s, const Pose2& robot, double left_m,
                       NavigatorWorld& world) {
  if (keeps_old(path, now_s, robot, left_m, world)) return false;
  path_ = std::move(path);
  nearest_ = 0;
  taken_s_ = now_s;
  advance(robot);
  return true;
}

}  // namespace trident::nav
