// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/motion_diagnosis.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "trident_base/string_util.h"

namespace trident::slam {
namespace {

std::string in_hundredths(double value) { return number_text(std::round(100.0 * value) / 100.0); }

}  // namespace

MotionDiagnosis diagnose_motion(const ScanPose2d& pose) {
  MotionDiagnosis diagnosis{"odometry", "none", ""};
  if (pose.motion_by == MotionBy::kScansAsAsked) diagnosis.motion_by = "scans, as asked";
  if (pose.motion_by == MotionBy::kScansAsOdometryStands) {
    diagnosis.motion_by = "scans, for odometry stands still";
    diagnosis.warning = "odometry stands still while scans move: the motion is that of the scans";
  }
  if (!pose.is_open) return diagnosis;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(
      pose.covariance.topLeftCorner<2, 2>());
  const Eigen::Vector2d along = solver.eigenvectors().col(1);
  const double sigma = std::sqrt(std::max(solver.eigenvalues()(1), 0.0));
  double yaw = std::atan2(along.y(), along.x());
  if (yaw < 0.0) yaw += M_PI;  // a direction without a sign
  diagnosis.open =
      in_hundredths(yaw) + " rad in the map, standard deviation " + in_hundredths(sigma) + " m";
  diagnosis.warning = "the scans leave a direction open: " + diagnosis.open;
  return diagnosis;
}

}  // namespace trident::slam
