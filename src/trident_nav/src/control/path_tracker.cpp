// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/control/path_tracker.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trident_base/angle.h"

namespace trident::nav {
namespace {

double direction(const Pose2& from, const Pose2& to) {
  return std::atan2(to.y - from.y, to.x - from.x);
}

// The same path as it was, up to a correction of the robot's position.
bool is_same_path(const Path& a, const Path& b, double tolerance_m) {
  if (a.size() != b.size() || a.empty()) return false;
  for (const std::size_t i : {std::size_t{0}, a.size() / 2, a.size() - 1}) {
    if (distance(a[i].x, a[i].y, b[i].x, b[i].y) > tolerance_m) return false;
  }
  return true;
}

}  // namespace

Pose2 LocalPath::at(double arc_m) const {
  if (poses.size() == 1 || spacing_m <= 0.0) return poses.front();
  const double place = std::clamp(arc_m / spacing_m, 0.0, static_cast<double>(poses.size() - 1));
  const auto i = std::min(static_cast<std::size_t>(place), poses.size() - 2);
  const double t = place - static_cast<double>(i);
  const Pose2& a = poses[i];
  const Pose2& b = poses[i + 1];
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y),
          wrap_angle(a.yaw + t * wrap_angle(b.yaw - a.yaw))};
}

void PathTracker::reset() { *this = PathTracker(max_advance_m_); }

void PathTracker::find_cusps() {
  has_headings_ = has_own_headings(path_);
  cusps_ = cusps_of(path_);
}

/// The points of a path that lie apart from each other, and their arc lengths.
void PathTracker::keep_points(const Path& path) {
  Path points;
  points.reserve(path.size());
  std::vector<double> arcs_m;
  for (const Pose2& pose : path) {
    const double step_m =
        points.empty() ? 0.0 : distance(points.back().x, points.back().y, pose.x, pose.y);
    if (!points.empty() && step_m < kPointApart) {
      points.back().yaw = pose.yaw;
      continue;
    }
    arcs_m.push_back(points.empty() ? 0.0 : arcs_m.back() + step_m);
    points.push_back(pose);
  }
  path_ = std::move(points);
  arcs_m_ = std::move(arcs_m);
}

void PathTracker::adopt(const Path& path) {
  constexpr double kCorrection = 0.3;  // [m]
  const bool is_kept = is_same_path(path_, path, kCorrection);
  keep_points(path);
  find_cusps();
  if (!is_kept) is_projected_ = false;
}

/// Onto the part of the path between two arc lengths.
PathTracker::Projection PathTracker::nearest(const Pose2& pose, double lo_m, double hi_m) const {
  Projection best;
  for (std::size_t i = 0; i + 1 < path_.size(); ++i) {
    if (arcs_m_[i + 1] < lo_m || arcs_m_[i] > hi_m) continue;
    const Pose2& a = path_[i];
    const Pose2& b = path_[i + 1];
    const double length_m = arcs_m_[i + 1] - arcs_m_[i];
    const double along_m = ((pose.x - a.x) * (b.x - a.x) + (pose.y - a.y) * (b.y - a.y)) / length_m;
    const double arc_m = std::clamp(arcs_m_[i] + std::clamp(along_m, 0.0, length_m), lo_m, hi_m);
    const double t = (arc_m - arcs_m_[i]) / length_m;
    const double d = distance(pose.x, pose.y, a.x + t * (b.x - a.x), a.y + t * (b.y - a.y));
    if (d < best.distance_m) best = {arc_m, d};
  }
  return best;
}

void PathTracker::project(const Pose2& pose) {
  if (path_.size() == 1) {
    arc_m_ = 0.0;
    deviation_m_ = distance(pose.x, pose.y, path_[0].x, path_[0].y);
    return;
  }
  const double lo_m = is_projected_ ? arc_m_ : 0.0;
  // Beyond a cusp the path may lie over itself: that part comes when the cusp is reached.
  const double hi_m = std::min(lo_m + max_advance_m_, end_of_part(arcs_m_.back()));
  Projection found = nearest(pose, lo_m, hi_m);
  if (found.distance_m > max_advance_m_) found = nearest(pose, 0.0, arcs_m_.back());
  arc_m_ = found.arc_m;
  deviation_m_ = found.distance_m;
  pass_cusp(is_projected_ ? lo_m : -std::numeric_limits<double>::infinity());
  is_projected_ = true;
}

/// Continues from a cusp that is passed. `last_m`: the arc length before.
void PathTracker::pass_cusp(double last_m) {
  const auto next = std::find_if(cusps_.begin(), cusps_.end(),
                                 [&](const Cusp& cusp) { return arcs_m_[cusp.index] > arc_m_; });
  if (next == cusps_.end()) return;
  const double cusp_m = arcs_m_[next->index];
  if (next->is_passed(cusp_m - arc_m_, cusp_m - last_m)) arc_m_ = cusp_m;
}

double PathTracker::end_of_part(double length_m) const {
  const double from_m = is_projected_ ? arc_m_ : 0.0;
  const double end_m = std::min(from_m + length_m, arcs_m_.back());
  for (const Cusp& cusp : cusps_) {
    const double cusp_m = arcs_m_[cusp.index];
    if (cusp_m > from_m) return std::min(end_m, cusp_m);
  }
  return end_m;
}

PathTracker::Place PathTracker::place_at(double arc_m) const {
  const auto after = std::upper_bound(arcs_m_.begin(), arcs_m_.end() - 1, arc_m);
  const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - arcs_m_.begin() - 1, 0));
  const std::size_t from = std::min(i, path_.size() - 2);
  const double share = (arc_m - arcs_m_[from]) / (arcs_m_[from + 1] - arcs_m_[from]);
  return {from, std::clamp(share, 0.0, 1.0)};
}

Pose2 PathTracker::pose_at(double arc_m) const {
  if (path_.size() == 1) return path_.front();
  const auto [from, share] = place_at(arc_m);
  const Pose2& a = path_[from];
  const Pose2& b = path_[from + 1];
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), direction(a, b)};
}

double PathTracker::heading_at(double arc_m) const {
  const auto after = std::upper_bound(arcs_m_.begin(), arcs_m_.end(), arc_m);
  const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - arcs_m_.begin() - 1, 0));
  return path_[std::min(i, path_.size() - 1)].yaw;
}

double PathTracker::heading_between(double arc_m) const {
  const auto [from, share] = place_at(arc_m);
  return wrap_angle(path_[from].yaw + share * wrap_angle(path_[from + 1].yaw - path_[from].yaw));
}

/// The robot's heading on an arc that the path has, and the arc's curvature.
void PathTracker::describe_arc(double end_m, LocalPath* local) const {
  constexpr double kOver_m = 0.06;
  local->heading = heading_between(arc_m_);
  const double over_m = std::min(kOver_m, end_m - arc_m_);
  if (over_m <= 0.0) return;
  local->curvature = wrap_angle(heading_between(arc_m_ + over_m) - local->heading) / over_m;
}

void PathTracker::add_points(std::size_t steps, LocalPath* local) const {
  for (std::size_t i = 0; i <= steps; ++i) {
    const double arc_m = arc_m_ + local->spacing_m * static_cast<double>(i);
    local->poses.push_back(pose_at(arc_m));
    if (has_headings_) local->headings.push_back(heading_at(arc_m));
  }
}

LocalPath PathTracker::update(const Path& path, const Pose2& pose, double spacing_m,
                              double length_m) {
  adopt(path);
  project(pose);
  LocalPath local;
  const double end_m = end_of_part(length_m);
  const double part_m = end_m - arc_m_;
  const auto steps = static_cast<std::size_t>(std::max(std::ceil(part_m / spacing_m), 0.0));
  local.spacing_m = steps > 0 ? part_m / static_cast<double>(steps) : spacing_m;
  local.remaining_m = arcs_m_.back() - arc_m_;
  local.deviation_m = deviation_m_;
  local.has_headings = has_headings_;
  local.reaches_goal = end_m >= arcs_m_.back();
  local.ends_at_cusp = !local.reaches_goal && end_m < arc_m_ + length_m;
  add_points(steps, &local);
  if (has_headings_ && steps > 0) {
    describe_arc(end_m, &local);
    const double off = wrap_angle(local.headings.front() - local.poses.front().yaw);
    local.is_reverse = std::fabs(off) > 0.5 * kPi;
  }
  return local;
}

}  // namespace trident::nav
