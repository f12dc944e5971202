// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "trident_nav/core/geometry.h"
#include "trident_nav/core/path_cusps.h"

namespace trident::nav {

/// The part of a path that is ahead, in points of equal spacing. The first is the robot's
/// projection onto the path; `yaw` is the direction of travel.
struct LocalPath {
  std::vector<Pose2> poses;  ///< At least one.
  double spacing_m = 0.0;
  double remaining_m = 0.0;      ///< Arc length from the first point to the path's end.
  double deviation_m = 0.0;      ///< Of the robot from the path.
  bool reaches_goal = false;     ///< The last point is the path's end.
  bool ends_at_cusp = false;     ///< The last point is where the direction of travel is reversed.
  bool is_reverse = false;       ///< The path's own headings want this part driven backwards.
  bool has_headings = false;     ///< The path has headings of its own that fit its direction.
  std::vector<double> headings;  ///< The path's own ones at the points, if it has any [rad].
  double heading = 0.0;          ///< The path's own one at the projection, between poses [rad].
  double curvature = 0.0;  ///< Of its headings from there on: the turn per path length [rad/m].

  double length_m() const { return spacing_m * static_cast<double>(poses.size() - 1); }
  /// The pose at an arc length, clamped to the ends.
  Pose2 at(double arc_m) const;
};

/// Follows the robot along a path: what it has passed is cut off, and of a path that crosses itself
/// or leads back the part is kept that comes next.
class PathTracker {
 public:
  /// How far ahead of the last projection the next one may lie [m].
  explicit PathTracker(double max_advance_m) : max_advance_m_(max_advance_m) {}

  /// The part ahead, up to `length_m`. `path` must not be empty; a new one is noticed.
  LocalPath update(const Path& path, const Pose2& pose, double spacing_m, double length_m);
  void reset();

  /// Arc length that the robot has made good on this path [m].
  double progress_m() const { return arc_m_; }

 private:
  /// Of the robot onto the path.
  struct Projection {
    double arc_m = 0.0;
    double distance_m = std::numeric_limits<double>::infinity();
  };

  void keep_points(const Path& path);
  void adopt(const Path& path);
  Projection nearest(const Pose2& pose, double lo_m, double hi_m) const;
  void project(const Pose2& pose);
  void find_cusps();
  void pass_cusp(double last_m);
  /// Between a point of the path and the next.
  struct Place {
    std::size_t from = 0;
    double share = 0.0;  ///< 0 at that point, 1 at the next.
  };
  Place place_at(double arc_m) const;
  Pose2 pose_at(double arc_m) const;
  double heading_at(double arc_m) const;
  double heading_between(double arc_m) const;
  void describe_arc(double end_m, LocalPath* local) const;
  void add_points(std::size_t steps, LocalPath* local) const;
  double end_of_part(double length_m) const;

  double max_advance_m_;
  Path path_;
  std::vector<double> arcs_m_;  ///< Of the path's points.
  std::vector<Cusp> cusps_;
  bool has_headings_ = false;
  bool is_projected_ = false;
  double arc_m_ = 0.0;
  double deviation_m_ = 0.0;
};

}  // namespace trident::nav
