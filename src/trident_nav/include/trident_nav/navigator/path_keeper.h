// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "trident_nav/core/geometry.h"
#include "trident_nav/core/path_cusps.h"
#include "trident_nav/navigator/navigator_params.h"
#include "trident_nav/navigator/navigator_world.h"

namespace trident::nav {

/// Holds the path that is followed. A new one replaces it only where the old one is blocked or
/// left, or costs more by `path_hysteresis`, and not before `commit_time` is over: a robot between
/// two routes that are about as good takes one of them.
class PathKeeper {
 public:
  explicit PathKeeper(const NavigatorParams& params)
      : hysteresis_(params.path_hysteresis), commit_s_(params.commit_time) {}
  void set_params(const NavigatorParams& params) {
    hysteresis_ = params.path_hysteresis;
    commit_s_ = params.commit_time;
  }

  void clear();
  bool has_path() const { return !path_.empty(); }
  const Path& path() const { return path_; }
  /// Whether it reverses its direction of travel anywhere.
  bool has_cusps() const { return !cusps_.empty(); }
  /// The part of the path from just behind the robot on.
  Path remaining() const;
  /// How far the robot has to drive to its end: back to it, and along it [m].
  double left_m(const Pose2& robot) const;

  /// Moves on along the path to the pose nearest to the robot, beyond a cusp not before that is
  /// reached.
  void advance(const Pose2& robot);
  /// Takes a new path if it is to be followed. `left_m`: farther than this from the old path, the
  /// robot has left it. Returns true when the path was taken.
  bool offer(Path path, double now_s, const Pose2& robot, double left_m, NavigatorWorld& world);

 private:
  bool keeps_old(const Path& path, double now_s, const Pose2& robot, double left_m,
                 NavigatorWorld& world) const;
  const Cusp* next_cusp() const;
  std::size_t last_of_part(const Cusp* cusp) const;
  double left_to(const Cusp& cusp, const Pose2& robot) const;
  void advance_to(std::size_t last, const Pose2& robot);

  double hysteresis_;
  double commit_s_;
  Path path_;
  std::vector<Cusp> cusps_;
  std::size_t nearest_ = 0;     // index of the pose nearest to the robot
  std::size_t part_begin_ = 0;  // of the cusp that was passed last
  double left_to_cusp_m_ = std::numeric_limits<double>::infinity();  // in the last call
  double taken_s_ = 0.0;
};

}  // namespace trident::nav
