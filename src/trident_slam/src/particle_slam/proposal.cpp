// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "proposal.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "matchers/map_match.h"
#include "trident_base/angle.h"

namespace trident::slam {
namespace {

constexpr int kIterations = 8;
constexpr double kSigma = 0.3;  ///< of 1 - M at a point that is where it should be

Eigen::Vector3d difference(const SE2& a, const SE2& b) {
  return {a.p.x() - b.p.x(), a.p.y() - b.p.y(), angle_difference(a.angle, b.angle)};
}

}  // namespace

Proposal propose(const ProbabilityGrid& map, const PointScan& scan, const PoseGaussian& motion,
                 double beam_weight) {
  const double scale = beam_weight / (kSigma * kSigma);
  const Eigen::Matrix3d prior = motion.covariance.inverse();
  Proposal result;
  SE2 at = motion.T_map_base;
  MapMatchSums sums = map_match_sums(map, scan, at);
  Eigen::Matrix3d information = prior;
  for (int i = 0; i < kIterations; ++i) {
    information = scale * sums.H + prior;
    const Eigen::Vector3d slope = scale * sums.g - prior * difference(at, motion.T_map_base);
    const Eigen::Vector3d step = information.ldlt().solve(slope);
    at = SE2::from_xy_yaw(at.p.x() + step[0], at.p.y() + step[1], at.angle + step[2]);
    sums = map_match_sums(map, scan, at);
    if (step.head<2>().norm() < 1e-4 && std::abs(step[2]) < 1e-5) break;
  }
  const Eigen::Vector3d moved = difference(at, motion.T_map_base);
  const double points = std::max<double>(1.0, static_cast<double>(scan.points.size()));
  result.pose.T_map_base = at;
  result.pose.covariance = (scale * sums.H + prior).inverse();
  result.score = 1.0 - std::sqrt(sums.cost / points);
  result.log_evidence = -0.5 * (scale * sums.cost + moved.dot(prior * moved)) +
                        0.5 * std::log(result.pose.covariance.determinant() * prior.determinant());
  return result;
}

}  // namespace trident::slam
