// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/hector_slam_2d.h"

#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "grids/probability_grid.h"
#include "matchers/map_match.h"
#include "motion/motion_filter.h"
#include "motion/motion_source.h"
#include "scans/scan_check.h"
#include "scans/start_pose.h"
#include "trident_base/angle.h"
#include "trident_slam/point_scan.h"
#include "trident_slam/slam_2d_factory.h"
#include "trident_slam/sweep_motion.h"

namespace trident::slam {
namespace {

constexpr int kCoarseIterations = 4;
constexpr int kFineIterations = 6;

}  // namespace

class HectorSlam2d::Impl {
 public:
  // All levels are filled with every scan, instead of deriving coarse ones from the finest: coarse
  // cells then see whole beams, as in the paper.
  explicit Impl(const HectorSlamParams& params)
      : params_(params),
        update_filter_({params.map_update_distance_thresh, params.map_update_angle_thresh}),
        motion_source_(params.use_odometry, OdometryMotion()) {
    double resolution = params.map_resolution;
    for (int level = 0; level < params.map_multi_res_levels; ++level, resolution *= 2.0) {
      levels_.emplace_back(resolution, params.update_factor_free, params.update_factor_occupied);
    }
  }

  /// A scan that cannot be used moves the pose by odometry alone, so that the next one is searched
  /// for near the right place.
  ScanPose2d add_scan(const LaserScan& scan, const SE2& T_odom_base) {
    ScanPose2d result;
    result.problem = check_.problem(scan);
    result.is_used = result.problem.empty();
    MotionSource::Step motion = motion_source_.next(scan.stamp_ns, T_odom_base);
    if (result.problem.empty()) result.problem = motion.problem;
    const SE2 T_map_before = T_map_base_;
    if (result.is_used) {
      result.covariance = use(scan, &motion);
    } else {
      T_map_base_ = T_map_base_ * motion.T_before_now;
    }
    result.motion_by = motion_source_.motion_by();
    const std::string change_of_odometry =
        motion_source_.settle(T_map_before.inverse() * T_map_base_, result.is_used);
    if (result.problem.empty()) result.problem = change_of_odometry;
    last_stamp_ns_ = scan.stamp_ns;
    result.T_map_base = T_map_base_;
    trajectory_.push_back({scan.stamp_ns, T_map_base_});
    return result;
  }

  void set_pose(const SE2& T_map_base) {
    check_start_pose(T_map_base, mapped_);
    T_map_base_ = T_map_base;
    T_map_mapped_.reset();
  }
  void set_uses_odometry(bool uses_odometry) {
    params_.use_odometry = uses_odometry;
    motion_source_.set_uses_odometry(uses_odometry);
  }
  const std::vector<StampedPose2d>& trajectory() const { return trajectory_; }
  OccupancyGrid map() const { return levels_.front().occupancy(); }

 private:
  // Deskewed by the predicted motion, matched from the coarsest level to the finest, and added to
  // the map only after the robot has moved: a robot at rest would make its own view ever more
  // certain.
  Eigen::Matrix3d use(const LaserScan& scan, MotionSource::Step* motion) {
    PointScanOptions options;
    options.min_range = params_.laser_min_dist;
    options.max_range = params_.laser_max_dist;
    const double seconds =
        params_.use_odometry ? 1e-9 * static_cast<double>(scan.stamp_ns - last_stamp_ns_) : 0.0;
    const auto shared = std::make_shared<const PointScan>(
        make_point_scan(scan, options, sweep_twist(scan, motion->T_before_now, seconds)));
    motion_source_.measure(shared, motion);
    const MapMatch match = matched(*shared, T_map_base_ * motion->T_before_now);
    T_map_base_ = match.T_map_base;
    if (has_moved()) add_to_map(*shared);
    return match.covariance;
  }

  // From the coarsest level to the finest; a pose that is known, or that nothing is known about,
  // stays as it is.
  MapMatch matched(const PointScan& points, const SE2& T_map_base) const {
    MapMatch match;
    match.T_map_base = T_map_base;
    if (!has_map_ || params_.map_with_known_poses) {
      match.covariance.setZero();
      return match;
    }
    for (std::size_t level = levels_.size(); level-- > 0;) {
      match = match_map(levels_[level], points, match.T_map_base,
                        level == 0 ? kFineIterations : kCoarseIterations);
    }
    return match;
  }

  void add_to_map(const PointScan& points) {
    for (ProbabilityGrid& level : levels_) level.insert(T_map_base_, points);
    T_map_mapped_ = T_map_base_;
    mapped_.extend(T_map_base_.p);
    has_map_ = true;
  }

  bool has_moved() const {
    return !T_map_mapped_ ||
           update_filter_.is_due((T_map_base_.p - T_map_mapped_->p).norm(),
                                 angle_difference(T_map_base_.angle, T_map_mapped_->angle));
  }

  HectorSlamParams params_;
  MotionFilter update_filter_;
  ScanCheck check_;
  MotionSource motion_source_;
  std::vector<ProbabilityGrid> levels_;  ///< finest first
  bool has_map_ = false;
  std::int64_t last_stamp_ns_ = 0;
  SE2 T_map_base_;
  std::optional<SE2> T_map_mapped_;  ///< where the map was updated last
  Eigen::AlignedBox2d mapped_;       ///< where the robot was when the map was updated [m]
  std::vector<StampedPose2d> trajectory_;
};

HectorSlam2d::HectorSlam2d(const HectorSlamParams& params)
    : impl_(std::make_unique<Impl>(params)) {}

HectorSlam2d::~HectorSlam2d() = default;

ScanPose2d HectorSlam2d::add_scan(const LaserScan& scan, const SE2& T_odom_base) {
  return impl_->add_scan(scan, T_odom_base);
}

std::vector<StampedPose2d> HectorSlam2d::trajectory() const { return impl_->trajectory(); }

OccupancyGrid HectorSlam2d::map() const { return impl_->map(); }

void HectorSlam2d::set_uses_odometry(bool uses_odometry) {
  impl_->set_uses_odometry(uses_odometry);
}

void HectorSlam2d::set_pose(const SE2& T_map_base) { impl_->set_pose(T_map_base); }

TRIDENT_SLAM_2D_METHOD(hector_slam_2d, "hector_slam_2d", HectorSlam2d, HectorSlamParams)

}  // namespace trident::slam
