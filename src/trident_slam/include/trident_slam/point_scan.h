// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "trident_base/laser_scan.h"

namespace trident::slam {

/// A point on a surface, and the surface's unit normal there, towards the sensor. The normal is
/// zero where the neighbouring beams show no surface.
struct SurfacePoint {
  Eigen::Vector2f p = Eigen::Vector2f::Zero();       ///< [m]
  Eigen::Vector2f normal = Eigen::Vector2f::Zero();  ///< length 1 or 0

  /// False: too few neighbors for one.
  bool has_normal() const { return normal.x() != 0.0F || normal.y() != 0.0F; }
};

/// What one sweep saw, in the frame of the robot's base at the sweep's stamp.
struct PointScan {
  Eigen::Vector2f origin = Eigen::Vector2f::Zero();  ///< of the laser [m]
  std::vector<SurfacePoint> points;                  ///< in the order of the beams
};

/// Which returns are believed.
struct PointScanOptions {
  double min_range = 0.05;  ///< [m]
  double max_range = 30.0;  ///< [m]
};

/// Turns ranges into points and normals. `twist` is the base's motion (vx, vy [m/s], w [rad/s])
/// while the sweep was taken: each point is put where the base at the stamp would have seen it.
PointScan make_point_scan(const LaserScan& scan, const PointScanOptions& options,
                          const Eigen::Vector3d& twist = Eigen::Vector3d::Zero());

}  // namespace trident::slam
