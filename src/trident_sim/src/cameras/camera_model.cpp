// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "camera_model.h"

#include <Eigen/LU>
#include <cmath>

namespace trident::sim {

// Brown and Conrady's model with OpenCV's coefficients, ROS' plumb_bob: k1, k2, k3 radial, t1 and
// t2 (OpenCV's p1, p2) tangential, on normalized image coordinates.
Eigen::Vector2d Distortion::apply(const Eigen::Vector2d& p) const {
  const double x = p.x(), y = p.y(), r2 = p.squaredNorm();
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2.0 * t1 * x * y + t2 * (r2 + 2.0 * x * x),
          y * radial + t1 * (r2 + 2.0 * y * y) + 2.0 * t2 * x * y};
}

Eigen::Matrix2d Distortion::slope(const Eigen::Vector2d& p) const {
  const double x = p.x(), y = p.y(), r2 = p.squaredNorm();
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double growth = 2.0 * (k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3));  // of radial, by p
  const double across = x * y * growth + 2.0 * (t1 * x + t2 * y);
  // The Jacobian is symmetric, as the distortion is the gradient of a potential.
  Eigen::Matrix2d slope;
  slope << radial + x * x * growth + 2.0 * t1 * y + 6.0 * t2 * x, across, across,
      radial + y * y * growth + 6.0 * t1 * y + 2.0 * t2 * x;
  return slope;
}

std::optional<Eigen::Vector2d> Distortion::undo(const Eigen::Vector2d& distorted) const {
  constexpr int kMaxRounds = 50;
  constexpr double kExact = 1e-12;
  // Newton's method from the middle outwards, in steps that the first fold cannot be jumped with.
  Eigen::Vector2d p = Eigen::Vector2d::Zero();
  for (int round = 0; round < kMaxRounds; ++round) {
    const Eigen::Vector2d error = distorted - apply(p);
    const Eigen::Matrix2d J = slope(p);
    // Where the picture folds over there is no inverse.
    if (!(J.determinant() > 1e-6) || !(J.trace() > 0.0)) return std::nullopt;
    if (error.squaredNorm() < kExact * kExact) return p;
    Eigen::Vector2d step = J.inverse() * error;
    const double longest = 0.25 * (1.0 + p.norm());
    if (step.norm() > longest) step *= longest / step.norm();
    p += step;
  }
  return std::nullopt;
}

CameraModel CameraModel::from_angle_of_view(int width, int height, double angle_rad) {
  CameraModel model;
  model.width = width;
  model.height = height;
  model.fx = model.fy = 0.5 * width / std::tan(0.5 * angle_rad);
  // Centers of pixels have whole coordinates, so that
  // the middle lies between them for an even width.
  model.cx = 0.5 * (width - 1);
  model.cy = 0.5 * (height - 1);
  return model;
}

Eigen::Vector2d CameraModel::project(const Eigen::Vector3d& p_optical) const {
  const Eigen::Vector2d p = distortion.apply(p_optical.head<2>() / p_optical.z());
  return {fx * p.x() + skew * p.y() + cx, fy * p.y() + cy};
}

std::optional<Eigen::Vector2d> CameraModel::back_project(const Eigen::Vector2d& pixel) const {
  const double y = (pixel.y() - cy) / fy;
  const Eigen::Vector2d p((pixel.x() - cx - skew * y) / fx, y);
  return distortion.is_none() ? p : distortion.undo(p);
}

}  // namespace trident::sim
