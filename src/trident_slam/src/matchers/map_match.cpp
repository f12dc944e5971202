// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "map_match.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace trident::slam {
namespace {

constexpr double kLargestTurn =
    0.2;  ///< [rad] of one step; a step beyond has left its linear model
/// Of an eigenvalue of H by its number of points [1/m^2]: below, the points say nothing there.
constexpr double kMinInformation = 1e-4;
/// Of 1 - M at a point that is where it should be.
constexpr double kResidualSigma = 0.3;

/// H^-1 without the directions of too small eigenvalues.
Eigen::Matrix3d bounded_inverse(const Eigen::Matrix3d& H, double least) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(H);
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const double value = solver.eigenvalues()[i];
    const Eigen::Vector3d v = solver.eigenvectors().col(i);
    if (value > least) inverse += v * v.transpose() / value;
  }
  return inverse;
}

}  // namespace

MapMatchSums map_match_sums(const ProbabilityGrid& map, const PointScan& scan,
                            const SE2& T_map_base) {
  // The sums by name, not as matrices, stay in registers.
  double xx = 0.0, xy = 0.0, xw = 0.0, yy = 0.0, yw = 0.0, ww = 0.0;
  double gx = 0.0, gy = 0.0, gw = 0.0;
  double cost = 0.0;
  const Eigen::Matrix2f R = T_map_base.rotation().cast<float>();
  const Eigen::Vector2f origin = T_map_base.p.cast<float>();
  for (const SurfacePoint& point : scan.points) {
    const Eigen::Vector2f arm = R * point.p;
    const ProbabilityGrid::Sample sample = map.sample(origin + arm);
    const Eigen::Vector3d J(sample.gradient.x(), sample.gradient.y(),
                            sample.gradient.y() * arm.x() - sample.gradient.x() * arm.y());
    const double residual = 1.0 - sample.value;
    xx += J.x() * J.x();
    xy += J.x() * J.y();
    xw += J.x() * J.z();
    yy += J.y() * J.y();
    yw += J.y() * J.z();
    ww += J.z() * J.z();
    gx += J.x() * residual;
    gy += J.y() * residual;
    gw += J.z() * residual;
    cost += residual * residual;
  }
  MapMatchSums sums;
  sums.H << xx, xy, xw, xy, yy, yw, xw, yw, ww;
  sums.g << gx, gy, gw;
  sums.cost = cost;
  return sums;
}

/// Gauss-Newton on the map's gradient (S. Kohlbrecher et al., "A Flexible and Scalable SLAM System
/// with Full 3D Motion Estimation", 2011). Information below the least stands for directions in
/// which nothing was seen.
MapMatch match_map(const ProbabilityGrid& map, const PointScan& scan, const SE2& guess,
                   int iterations) {
  MapMatch match;
  match.T_map_base = guess;
  const double least = kMinInformation * static_cast<double>(scan.points.size()) /
                       (map.resolution() * map.resolution());
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  for (int i = 0; i < iterations; ++i) {
    const MapMatchSums sums = map_match_sums(map, scan, match.T_map_base);
    H = sums.H;
    Eigen::Vector3d step = bounded_inverse(H, least) * sums.g;
    step[2] = std::clamp(step[2], -kLargestTurn, kLargestTurn);
    match.T_map_base =
        SE2::from_xy_yaw(match.T_map_base.p.x() + step[0], match.T_map_base.p.y() + step[1],
                         match.T_map_base.angle + step[2]);
  }
  match.covariance =
      kResidualSigma * kResidualSigma * (H + least * Eigen::Matrix3d::Identity()).inverse();
  return match;
}

}  // namespace trident::slam
