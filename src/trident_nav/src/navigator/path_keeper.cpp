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

/// From a robot to the nearest place between two poses, less what that is from the first one [m].
double off_segment(const Pose2& a, const Pose2& b, const Pose2& robot) {
  const double length_m = distance_to(a, b);
  if (length_m < kPointApart) return distance_to(a, robot);
  const double along_m = ((robot.x - a.x) * (b.x - a.x) + (robot.y - a.y) * (b.y - a.y)) / length_m;
  const double kept_m = std::clamp(along_m, 0.0, length_m);
  const double t = kept_m / length_m;
  return distance(robot.x, robot.y, a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)) - kept_m;
}

}  // namespace

void PathKeeper::clear() {
  path_.clear();
  cusps_.clear();
  nearest_ = 0;
  part_begin_ = 0;
  left_to_cusp_m_ = std::numeric_limits<double>::infinity();
}

Path PathKeeper::remaining() const {
  constexpr std::size_t kBehind = 2;  // poses: the robot lies between two of them
  const std::size_t first = std::max(nearest_ - std::min(nearest_, kBehind), part_begin_);
  return {path_.begin() + static_cast<std::ptrdiff_t>(first), path_.end()};
}

double PathKeeper::left_m(const Pose2& robot) const {
  if (path_.empty()) return 0.0;
  double left_m = distance_to(path_[nearest_], robot);
  for (std::size_t i = nearest_; i + 1 < path_.size(); ++i) {
    const double step_m = distance_to(path_[i], path_[i + 1]);
    // The robot lies between two poses.
    if (i == nearest_) left_m = std::min(left_m, off_segment(path_[i], path_[i + 1], robot));
    left_m += step_m;
  }
  return left_m;
}

/// The pose up to which the robot drives in one direction.
const Cusp* PathKeeper::next_cusp() const {
  const auto next = std::find_if(cusps_.begin(), cusps_.end(),
                                 [&](const Cusp& cusp) { return cusp.index > part_begin_; });
  return next == cusps_.end() ? nullptr : &*next;
}

/// What is left to a cusp, along the direction in which the path comes to it.
double PathKeeper::left_to(const Cusp& cusp, const Pose2& robot) const {
  const Pose2& end = path_[cusp.index];
  std::size_t before = cusp.index;
  while (before > part_begin_ && distance_to(path_[before], end) < kPointApart) --before;
  const double step_m = distance_to(path_[before], end);
  if (step_m < kPointApart) return 0.0;
  return ((end.x - robot.x) * (end.x - path_[before].x) +
          (end.y - robot.y) * (end.y - path_[before].y)) /
         step_m;
}

/// The nearest pose up to an index. Looks ahead only as far as the path leads away from the robot
/// by no more than this: of a path that comes back, the part that is driven first is kept.
void PathKeeper::advance_to(std::size_t last, const Pose2& robot) {
  constexpr double kLookahead_m = 1.0;
  double least = distance_to(path_[nearest_], robot), walked = 0.0;
  std::size_t best = nearest_;
  for (std::size_t i = nearest_ + 1; i <= last && walked < kLookahead_m + least; ++i) {
    walked += distance_to(path_[i - 1], path_[i]);
    const double d = distance_to(path_[i], robot);
    if (d > least) continue;
    least = d;
    best = i;
  }
  nearest_ = best;
}

/// Of the part up to a cusp, or to the path's end.
std::size_t PathKeeper::last_of_part(const Cusp* cusp) const {
  return cusp != nullptr ? cusp->index : path_.size() - 1;
}

void PathKeeper::advance(const Pose2& robot) {
  if (path_.empty()) return;
  const Cusp* cusp = next_cusp();
  advance_to(last_of_part(cusp), robot);
  // Beyond a cusp the path lies next to itself: that part comes when the cusp is reached.
  while (cusp != nullptr && nearest_ + 1 >= cusp->index) {
    const double left_m = left_to(*cusp, robot);
    const bool is_passed = cusp->is_passed(left_m, std::exchange(left_to_cusp_m_, left_m));
    if (!is_passed) break;
    part_begin_ = nearest_ = cusp->index;
    left_to_cusp_m_ = std::numeric_limits<double>::infinity();
    cusp = next_cusp();
    advance_to(last_of_part(cusp), robot);
  }
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
  clear();
  path_ = std::move(path);
  cusps_ = cusps_of(path_);
  taken_s_ = now_s;
  advance(robot);
  return true;
}

}  // namespace trident::nav
