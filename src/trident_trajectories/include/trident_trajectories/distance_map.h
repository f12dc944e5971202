// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

namespace trident::trajectories {

/// How far the nearest thing that stands still is. Implementations are read by several threads at
/// once and never change.
class DistanceMap {
 public:
  virtual ~DistanceMap() = default;

  /// The distance [m] from `p` (common frame) to the nearest surface, negative inside of things,
  /// and its gradient. Must not grow faster than by 1 m per m: what lies between samples is judged
  /// by that.
  virtual double distance(const Eigen::Vector3d& p, Eigen::Vector3d& gradient) const = 0;
};

/// A sphere, or an upright cylinder that reaches from the ground to the sky.
struct RoundObstacle {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< [m]
  double radius = 1.0;                               ///< > 0 [m]
  bool is_cylinder = true;                           ///< z counts for a sphere alone
};

/// Things whose distance is a closed form.
class RoundObstacles : public DistanceMap {
 public:
  /// Throws Error naming the obstacle: not finite, or a radius that is not positive.
  explicit RoundObstacles(std::vector<RoundObstacle> obstacles);
  double distance(const Eigen::Vector3d& p, Eigen::Vector3d& gradient) const override;

 private:
  std::vector<RoundObstacle> obstacles_;
};

/// Distances at the nodes of a regular grid: of an occupancy grid (one layer: z does not count), or
/// of a cloud. Between nodes they are interpolated linearly along each axis; outside, the nearest
/// node of the border counts.
class GridDistanceMap : public DistanceMap {
 public:
  /// Where the nodes are.
  struct Grid {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of node (0, 0, 0) [m]
    double spacing = 0.5;                              ///< > 0 [m]
    Eigen::Vector3i nodes = {2, 2, 1};  ///< along x and y >= 2, along z 1 (plane) or >= 2
  };

  /// `distances` [m], x fastest, then y, then z. Throws Error naming field, value and legal range.
  GridDistanceMap(const Grid& grid, std::vector<double> distances);

  /// The nodes of `grid` with the distances of another map, which is then looked up faster.
  static GridDistanceMap sampled(const Grid& grid, const DistanceMap& map);

  /// The nodes of `grid` with the distances to the points of a cloud [m].
  static GridDistanceMap of_cloud(const Grid& grid, const std::vector<Eigen::Vector3d>& points);

  double distance(const Eigen::Vector3d& p, Eigen::Vector3d& gradient) const override;

 private:
  Grid grid_;
  std::vector<double> distances_;
};

}  // namespace trident::trajectories
