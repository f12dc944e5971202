// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

namespace trident::sim {

/// Radial (k) and tangential (t) distortion as ROS' "plumb_bob" has it: where a point at x, y of
/// the plane z = 1 appears,
///   x' = x (1 + k1 r^2 + k2 r^4 + k3 r^6) + 2 t1 x y + t2 (r^2 + 2 x^2), and y' by symmetry
/// (Brown 1966; OpenCV calls t1, t2 p1, p2).
struct Distortion {
  double k1 = 0.0, k2 = 0.0, k3 = 0.0, t1 = 0.0, t2 = 0.0;

  bool is_none() const { return k1 == 0.0 && k2 == 0.0 && k3 == 0.0 && t1 == 0.0 && t2 == 0.0; }
  Eigen::Vector2d apply(const Eigen::Vector2d& p) const;
  /// How apply() changes with p.
  Eigen::Matrix2d slope(const Eigen::Vector2d& p) const;
  /// What apply() brings to `distorted`; none: nothing that is seen only once does.
  std::optional<Eigen::Vector2d> undo(const Eigen::Vector2d& distorted) const;
};

/// A pinhole with distortion. Pixels are counted from the middle of the upper left one, which is
/// (0, 0), as in sensor_msgs/CameraInfo; so the middle of the picture is at ((w - 1) / 2,
/// (h - 1) / 2). Optical frame: x right, y down, z ahead.
///
/// Pictures are always drawn through the very numbers that CameraInfo contains. The plugins of
/// gazebo_plugins publish ((w + 1) / 2, (h + 1) / 2), so their pictures are shifted by one pixel
/// against ours; in Gazebo the picture is not, and disagrees with its CameraInfo.
struct CameraModel {
  int width = 0, height = 0;
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< [pixels]
  double skew = 0.0;  ///< how far right a point at y = 1 appears of one at y = 0 [pixels]
  Distortion distortion;

  /// Square pixels and the middle of the picture. Angle of view along a row [rad].
  static CameraModel from_angle_of_view(int width, int height, double angle_rad);

  /// Pixel at which a point ahead of the camera (z > 0) appears.
  Eigen::Vector2d project(const Eigen::Vector3d& p_optical) const;
  /// Point of the plane z = 1 that appears at a pixel; none: see Distortion::undo().
  std::optional<Eigen::Vector2d> back_project(const Eigen::Vector2d& pixel) const;
};

}  // namespace trident::sim
