// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "front_end/surface_information.h"

#include <algorithm>

namespace trident {
namespace {

/// Points that see more than this are neighbours of one another's, which err alike.
constexpr double kIndependentPoints = 200.0;
/// Of a point without a normal, in both directions.
constexpr double kPointWeight = 0.1;

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

double mean_range(const PointScan& scan) {
  double sum = 0.0;
  for (const SurfacePoint& point : scan.points) sum += static_cast<double>(point.p.norm());
  return scan.points.empty() ? 0.0 : sum / static_cast<double>(scan.points.size());
}

}  // namespace trident
