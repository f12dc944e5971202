// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace trident::bridges {

/// Where a vehicle may be. Places are of the world, heights above home.
struct Fence {
  /// A polygon of three corners or more, or a circle.
  struct Region {
    bool is_inclusion = true;                            ///< must be inside, else must be outside
    std::vector<Eigen::Vector2d> corners_m;              ///< empty: a circle
    Eigen::Vector2d center_m = Eigen::Vector2d::Zero();  ///< of a circle
    double radius_m = 0.0;                               ///< of a circle
  };
  std::vector<Region> regions;                       ///< each must be kept
  Eigen::Vector3d home_m = Eigen::Vector3d::Zero();  ///< for the two limits below
  double radius_m = 0.0;                             ///< around home; 0: none
  double height_m = 0.0;                             ///< above home; 0: none

  /// What a place breaks: rule, value and limit; nothing where it may be.
  std::optional<std::string> breach(const Eigen::Vector3d& p_world_m) const;
};

/// Whether a point lies in a polygon (even-odd rule); the edge counts as either.
bool is_inside(const std::vector<Eigen::Vector2d>& corners, const Eigen::Vector2d& point);

/// What is not legal about a region, with the legal range; empty: nothing.
std::string problem_of(const Fence::Region& region);

}  // namespace trident::bridges
