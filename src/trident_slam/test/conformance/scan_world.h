// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "trident_base/laser_scan.h"
#include "trident_base/random_stream.h"
#include "trident_base/se2.h"

namespace trident::slam::testing_world {

/// A room of 12 m x 8 m with an alcove, a pier and free-standing posts, driven through on a closed
/// course of two laps by a robot with a scanner of 360 beams and odometry that turns 3 % too far.
class ScanWorld {
 public:
  explicit ScanWorld(std::uint64_t seed);

  struct Step {
    LaserScan scan;
    SE2 T_odom_base;
    SE2 T_start_base;  ///< the truth, from where the first scan was taken
  };
  const std::vector<Step>& steps() const { return steps_; }

  /// Distance from a point of the first scan's frame to the nearest wall or post [m].
  double distance_to_surface(const Eigen::Vector2d& p_start) const;

 private:
  struct Wall {
    Eigen::Vector2d a, b;
  };
  struct Post {
    Eigen::Vector2d center;
    double radius;
  };
  double range(const Eigen::Vector2d& from, double angle) const;
  LaserScan scan_at(const SE2& T_world_base, std::size_t k) const;
  void add_box(double x, double y, double width, double height);

  RandomStream noise_;
  std::vector<Wall> walls_;
  std::vector<Post> posts_;
  SE2 T_world_start_;
  std::vector<Step> steps_;
};

}  // namespace trident::slam::testing_world
