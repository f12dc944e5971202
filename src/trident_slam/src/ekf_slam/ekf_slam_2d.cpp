// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/ekf_slam_2d.h"
#include "trident_slam/slam_2d_factory.h"

#include <cmath>

#include "graph_slam/local/scan_archive.h"
#include "logs/scan_map.h"
#include "motion/odometry_motion.h"
#include "posts.h"
#include "scans/scan_check.h"

namespace trident::slam {

class EkfSlam2d::Impl {
 public:
  explicit Impl(const EkfSlam2dParams& params) : params_(params), filter_(params.filter) {}

  /// Prediction by odometry, then correction by the posts that the scan shows. A scan that cannot
  /// be used predicts only.
  ScanPose2d add_scan(const LaserScan& scan, const SE2& T_odom_base) {
    const OdometryMotion::Step motion = odometry_.next(T_odom_base);
    filter_.predict(motion.T_before_now, motion_covariance(motion));
    ScanPose2d result;
    result.problem = check_.problem(scan);
    result.is_used = result.problem.empty();
    if (result.problem.empty()) result.problem = motion.problem;
    if (result.is_used) filter_.observe(find_posts(scan, params_.posts));
    result.T_map_base = filter_.T_map_base();
    result.covariance = filter_.pose_covariance();

    ScanArchive::Entry entry;
    entry.stamp_ns = scan.stamp_ns;
    entry.T_keyframe_base = result.T_map_base;
    entry.is_used = result.is_used;
    archive_.add(scan, entry, scan.range_max);
    return result;
  }

  std::vector<StampedPose2d> trajectory() const {
    std::vector<StampedPose2d> poses;
    for (std::size_t i = 0; i < archive_.size(); ++i) {
      poses.push_back({archive_[i].stamp_ns, archive_[i].T_keyframe_base});
    }
    return poses;
  }

  /// The filter's own map is of landmarks; this one is of all scans at the poses of the filter, for
  /// who wants a grid.
  OccupancyGrid map() const {
    ScanMapOptions options;
    options.resolution = params_.resolution;
    std::vector<std::size_t> used;
    for (std::size_t i = 0; i < archive_.size(); ++i) {
      if (archive_[i].is_used) used.push_back(i);
    }
    LaserScan scan;
    const auto placed = [&](std::size_t k) {
      scan = archive_.scan(used[k]);
      return PlacedScan{&scan, archive_[used[k]].T_keyframe_base};
    };
    return build_scan_map(used.size(), placed, options);
  }

  const EkfSlam& filter() const { return filter_; }

 private:
  Eigen::Matrix3d motion_covariance(const OdometryMotion::Step& motion) const {
    constexpr double kLostMeters = 1.0;  // where odometry reported nothing
    constexpr double kLostYaw = 0.5;
    if (!motion.problem.empty()) {
      return Eigen::Vector3d(kLostMeters, kLostMeters, kLostYaw).cwiseAbs2().asDiagonal();
    }
    const double meters = motion.T_before_now.p.norm();
    const double along = params_.odometry_distance_sigma * meters;
    const double across = params_.odometry_slip_sigma * meters;
    const double turn = std::hypot(params_.odometry_turn_sigma * motion.T_before_now.angle,
                                   params_.odometry_drift_sigma * meters);
    return Eigen::Vector3d(along, across, turn).cwiseAbs2().asDiagonal();
  }

  EkfSlam2dParams params_;
  EkfSlam filter_;
  OdometryMotion odometry_;
  ScanCheck check_;
  ScanArchive archive_;
};

EkfSlam2d::EkfSlam2d(const EkfSlam2dParams& params) : impl_(std::make_unique<Impl>(params)) {}

EkfSlam2d::~EkfSlam2d() = default;

ScanPose2d EkfSlam2d::add_scan(const LaserScan& scan, const SE2& T_odom_base) {
  return impl_->add_scan(scan, T_odom_base);
}

std::vector<StampedPose2d> EkfSlam2d::trajectory() const { return impl_->trajectory(); }

OccupancyGrid EkfSlam2d::map() const { return impl_->map(); }

std::vector<EkfSlam::Landmark> EkfSlam2d::landmarks() const { return impl_->filter().landmarks(); }

TRIDENT_SLAM_2D_METHOD(ekf_slam_2d, "ekf_slam_2d", EkfSlam2d, EkfSlam2dParams)

}  // namespace trident::slam
