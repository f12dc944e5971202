// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation_ros/amcl_localizer.h"

#include <utility>

namespace trident::estimation {

void AmclLocalizer::set_map(const OccupancyGrid& map) {
  // Made before anything changes: a map that is refused leaves the last one in use.
  auto filter = std::make_unique<Amcl>(params_.filter, map);
  filter_ = std::move(filter);
  has_pose_ = false;
  T_global_odom_.reset();
  const Eigen::Vector3d variances(params_.initial_cov_xx, params_.initial_cov_yy,
                                  params_.initial_cov_aa);
  filter_->set_pose(
      SE2::from_xy_yaw(params_.initial_pose_x, params_.initial_pose_y, params_.initial_pose_a),
      variances.asDiagonal());
  if (params_.start_anywhere) filter_->set_anywhere();
}

void AmclLocalizer::set_pose(const SE2& T_global_base, const Eigen::Matrix3d& covariance) {
  filter_->set_pose(T_global_base, covariance);
  T_global_odom_.reset();
  if (T_odom_scan_) T_global_odom_ = filter_->estimate().T_map_base * T_odom_scan_->inverse();
}

void AmclLocalizer::forget_odometry() {
  if (filter_) filter_->forget_odometry();
  T_odom_scan_.reset();
}

AmclStep AmclLocalizer::update(const PlacedScan& placed) {
  AmclStep step = filter_->update(placed.scan, placed.T_odom_base, placed.T_start_end);
  searches_ += step.is_searched ? 1 : 0;
  if (step.is_updated) {
    ++updates_;
    has_pose_ = true;
    T_odom_scan_ = placed.T_odom_base;
    T_global_odom_ = filter_->estimate().T_map_base * placed.T_odom_base.inverse();
  }
  return step;
}

}  // namespace trident::estimation
