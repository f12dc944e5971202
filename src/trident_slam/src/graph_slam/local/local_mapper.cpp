// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "local_mapper.h"

#include "matchers/surface_information.h"

namespace trident::slam {
namespace {

ScanTrackerOptions tracker_options(const GraphSlamOptions& options) {
  ScanTrackerOptions result;
  result.noise.distance_per_meter = options.odometry_distance_noise;
  result.noise.yaw_per_radian = options.odometry_heading_noise;
  result.noise.other = options.front_end.odometry_noise;
  result.tracking = options.front_end.tracking;
  result.search = options.front_end.tracking_search;
  return result;
}

MotionFilter keyframe_filter(const GraphSlamOptions& options) {
  return MotionFilter({options.minimum_travel_distance, options.minimum_travel_heading});
}

}  // namespace

LocalMapper::LocalMapper(const GraphSlamOptions& options, const KeyframeGraph* graph)
    : options_(options),
      graph_(graph),
      keyframe_filter_(keyframe_filter(options)),
      motion_source_(options.use_odometry,
                     OdometryMotion(options.odometry_jump_distance, options.odometry_jump_heading)),
      calibration_(options.calibrate_odometry, options.front_end.calibration),
      tracker_(tracker_options(options)),
      recent_scans_(static_cast<std::size_t>(options.scan_buffer_size),
                    options.scan_buffer_maximum_scan_distance, tracker_.options().line),
      kidnap_detector_(options.front_end.localization, options.front_end.relocalization,
                       options.back_end.free_space) {
  if (options.scan_matcher != GraphSlamOptions::kLinesOfTheMap) {
    submap_matcher_.emplace(options.scan_matcher, options.front_end.matcher_reference);
    tracker_.set_refine(
        [this](const PointScan& scan, const SE2& guess, const PosePrior& prior) -> MatchResult {
          return submap_matcher_->match(*graph_, tracker_.surfels(), scan, guess, prior);
        });
  }
  tracker_.set_pose(SE2::from_xy_yaw(options.map_start_pose[0], options.map_start_pose[1],
                                     options.map_start_pose[2]));
}

LocalMapper::Motion LocalMapper::predict(std::int64_t stamp_ns, const SE2& T_odom_base) {
  Motion motion = motion_source_.next(stamp_ns, T_odom_base);
  if (!motion.by_scans) {
    travelled_ += motion.T_before_now.p.norm();
    motion.T_before_now = calibration_.calibrated(motion.T_before_now);
  }
  return motion;
}

/// Odometry is calibrated only by motion that it has reported itself, and interrupted otherwise:
/// motion that scans have measured would confirm itself.
MatchResult LocalMapper::match(const std::shared_ptr<const PointScan>& points,
                               const SE2& T_base_laser, Motion* motion) {
  motion_source_.measure(points, motion);
  if (!options_.use_scan_matching) {
    tracker_.coast(*motion);
    return {};
  }
  const SE2 T_map_last = tracker_.T_map_base();
  tracker_.set_distance_noise(options_.odometry_distance_noise * calibration_.noise_fraction());
  MatchResult match = tracker_.track(*points, *motion);
  if (motion->problem.empty() && !motion->by_scans) {
    calibration_.learn(T_base_laser, T_map_last.inverse() * match.T_ref_base, match);
  } else {
    calibration_.interrupt();
  }
  if (options_.mode != SlamMode::kLocalization) return match;
  return localize(points, *motion, match);
}

// The map does not change here: what it does not explain may be new, or the robot is elsewhere.
MatchResult LocalMapper::localize(const std::shared_ptr<const PointScan>& points,
                                  const Motion& motion, const MatchResult& tracked) {
  MatchResult match = tracked;
  fall_back_to_recent_scans(points, &match);
  const auto found = kidnap_detector_.check(*graph_, tracker_.surfels(), *points,
                                            motion.T_before_now, match, tracker_.options().line);
  if (!found) return match;
  tracker_.set_pose(found->T_ref_base);
  recent_scans_.clear();
  return *found;
}

// Where the map explains too little of a scan, the scans before it may: the map ends here, or what
// it shows has been moved.
void LocalMapper::fall_back_to_recent_scans(const std::shared_ptr<const PointScan>& points,
                                            MatchResult* match) {
  const double enough = options_.front_end.localization.min_inliers;
  if (match->inlier_fraction < enough) {
    MatchResult refined = *match;
    refined.inlier_fraction = recent_scans_.refine(*points, &refined);
    if (refined.inlier_fraction < enough) return;
    *match = refined;  // whose fit shows that the robot is not lost
    tracker_.set_pose(match->T_ref_base);
  }
  if (!recent_scans_.empty() && !has_moved_from(recent_scans_.newest())) return;
  recent_scans_.add(tracker_.T_map_base(), points);
}

void LocalMapper::coast(const Motion& motion) {
  tracker_.coast(motion);
  calibration_.interrupt();
}

MatchResult LocalMapper::match_again(const PointScan& points, const PosePrior& prior) {
  MatchResult match =
      match_lines(tracker_.surfels(), points, prior.T_ref_base, prior, tracker_.options().line);
  tracker_.set_pose(match.T_ref_base);
  return match;
}

std::string LocalMapper::finish_motion(const Motion& motion, bool is_shown) {
  const SE2& T_before_now = tracker_.T_before_now();
  if (motion.by_scans) travelled_ += T_before_now.p.norm();
  return motion_source_.settle(T_before_now, is_shown);
}

void LocalMapper::report_uncertainty(const Motion& motion, const MatchResult& match,
                                     const PointScan& points, ScanPose2d* result) {
  result->motion_by = motion_source_.motion_by();
  result->covariance = match.covariance;
  if (tracker_.surfels().empty()) return;  // here the map begins
  if (motion.by_scans && options_.use_scan_matching) {
    uncertainty_.add(motion_source_.scan_step(), match, mean_range(points));
    result->is_open = uncertainty_.is_open();
  } else {
    uncertainty_.set(match.covariance);
  }
  result->covariance = uncertainty_.covariance();
}

void LocalMapper::set_pose(const SE2& T_map_base) {
  tracker_.set_pose(T_map_base);
  calibration_.interrupt();
  recent_scans_.clear();
  kidnap_detector_.reset();
}

void LocalMapper::set_mode(SlamMode mode) {
  options_.mode = mode;
  recent_scans_.clear();
}

}  // namespace trident::slam
