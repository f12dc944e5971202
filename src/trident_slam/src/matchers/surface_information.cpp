// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "surface_information.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "trident_base/angle.h"

namespace trident::slam {
namespace {

/// Points that see more than this are neighbors of one another's, which err alike.
constexpr double kIndependentPoints = 200.0;
/// Of a point without a normal, in both directions.
constexpr double kPointWeight = 0.1;
/// Of the largest eigenvalue, what errors of the normals bring along a wall.
constexpr double kNoise = 0.01;

/// Directions of an information and what is known along them, yaw counted at a range.
struct Axes {
  Axes(const Eigen::Matrix3d& information, double range)
      : to_meters(1.0, 1.0, std::max(range, 0.1)) {
    const Eigen::Vector3d to_pose = to_meters.cwiseInverse();
    const Eigen::Matrix3d scaled = to_pose.asDiagonal() * information * to_pose.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scaled);
    values = solver.eigenvalues();
    directions = solver.eigenvectors();
  }
  /// Of each direction, the fraction known from surfaces and not from errors of their normals.
  Eigen::Vector3d known_fractions() const {
    constexpr double kAll = Degeneracy::kDegenerateRatio;
    const Eigen::Vector3d ratios = values / std::max(values[2], 1e-12);
    return ((ratios.array() - kNoise) / (kAll - kNoise)).max(0.0).min(1.0);
  }

  Eigen::Vector3d to_meters;
  Eigen::Vector3d values;
  Eigen::Matrix3d directions;
};

}  // namespace

Eigen::Matrix3d surface_information(const PointScan& scan, const SE2& T_ref_base,
                                    const std::vector<char>& is_on_surface, double sigma) {
  const Eigen::Matrix2d R = T_ref_base.rotation();
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    if (is_on_surface[i] == 0) continue;
    const Eigen::Vector2d arm = R * scan.points[i].p.cast<double>();
    const Eigen::Vector2d side(-arm.y(), arm.x());
    const auto add = [&](const Eigen::Vector2d& n, double weight) {
      const Eigen::Vector3d J(n.x(), n.y(), n.dot(side));
      sum += weight * J * J.transpose();
    };
    if (scan.points[i].has_normal()) {
      add(R * scan.points[i].normal.cast<double>(), 1.0);
    } else {
      add(Eigen::Vector2d::UnitX(), kPointWeight);
      add(Eigen::Vector2d::UnitY(), kPointWeight);
    }
  }
  const auto points = static_cast<double>(std::max<std::size_t>(scan.points.size(), 1));
  return std::min(1.0, kIndependentPoints / points) / (sigma * sigma) * sum;
}

Eigen::Matrix3d without_noise(const Eigen::Matrix3d& information, double range) {
  const Axes axes(information, range);
  const Eigen::Vector3d rest =
      (axes.values.array() - kNoise * std::max(axes.values[2], 0.0)).max(0.0);
  const Eigen::Matrix3d scaled = axes.directions * rest.asDiagonal() * axes.directions.transpose();
  return axes.to_meters.asDiagonal() * scaled * axes.to_meters.asDiagonal();
}

SE2 held_where_degenerate(const SE2& T, const SE2& anchor, const Eigen::Matrix3d& information,
                          double range) {
  const Axes axes(information, range);
  const Eigen::Vector3d moved(T.p.x() - anchor.p.x(), T.p.y() - anchor.p.y(),
                              angle_difference(T.angle, anchor.angle));
  const Eigen::Vector3d along = axes.directions.transpose() * axes.to_meters.cwiseProduct(moved);
  const Eigen::Vector3d kept =
      (axes.directions * axes.known_fractions().cwiseProduct(along)).cwiseQuotient(axes.to_meters);
  return SE2::from_xy_yaw(anchor.p.x() + kept.x(), anchor.p.y() + kept.y(),
                          anchor.angle + kept.z());
}

void discard_degenerate(double range, Eigen::Matrix3d* information, Eigen::Vector3d* gradient) {
  const Axes axes(*information, range);
  const Eigen::Vector3d known_fractions = axes.known_fractions();
  if ((known_fractions.array() == 1.0).all()) return;
  const Eigen::Matrix3d scaled = axes.directions *
                                 known_fractions.cwiseProduct(axes.values).asDiagonal() *
                                 axes.directions.transpose();
  *information = axes.to_meters.asDiagonal() * scaled * axes.to_meters.asDiagonal();
  const Eigen::Vector3d along =
      axes.directions.transpose() * gradient->cwiseQuotient(axes.to_meters);
  *gradient = axes.to_meters.cwiseProduct(axes.directions * known_fractions.cwiseProduct(along));
}

double mean_range(const PointScan& scan) {
  double sum = 0.0;
  for (const SurfacePoint& point : scan.points) sum += static_cast<double>(point.p.norm());
  return scan.points.empty() ? 0.0 : sum / static_cast<double>(scan.points.size());
}

}  // namespace trident::slam
