// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/control/moving_obstacles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "trident_base/angle.h"

namespace trident::nav {
namespace {

constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();

SE3 pose_between(Span<const SE3> poses, double fraction) {
  const double place = fraction * static_cast<double>(poses.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), poses.size() - 2);
  const double along = place - static_cast<double>(i);
  const SE3 &a = poses[i], &b = poses[i + 1];
  SE3 result;
  result.R = a.R.slerp(along, b.R);
  result.p = a.p + along * (b.p - a.p);
  return result;
}

}  // namespace

ScanPoints scan_points(const LaserScan& scan, Span<const SE3> T_costmap_laser,
                       const HeightBand& heights) {
  const std::size_t beams = scan.size();
  const bool is_still = T_costmap_laser.size() == 1;
  const double span = std::max(static_cast<double>(beams) - 1.0, 1.0);
  SE3 pose = T_costmap_laser[0];
  ScanPoints points;
  points.sensor = {pose.p.x(), pose.p.y()};
  points.angle_increment = std::fabs(scan.angle_increment);
  points.first_angle = pose.rpy().z() + scan.angle_min;
  points.is_clockwise = scan.angle_increment < 0.0;
  // One beam more would be at the first one, or pass it.
  points.is_full_turn = points.angle_increment * (static_cast<double>(beams) + 0.5) >= 2.0 * kPi;
  points.ends.assign(beams, {kNowhere, kNowhere});
  for (std::size_t i = 0; i < beams; ++i) {
    const auto range_m = static_cast<double>(scan.ranges[i]);
    if (!scan.is_return(i) || range_m >= scan.range_max) continue;
    if (!is_still) pose = pose_between(T_costmap_laser, static_cast<double>(i) / span);
    const double angle = scan.angle(i);
    const Eigen::Vector3d p =
        pose.p + pose.R * Eigen::Vector3d(range_m * std::cos(angle), range_m * std::sin(angle), 0);
    if (p.z() >= heights.low_m && p.z() <= heights.high_m) points.ends[i] = {p.x(), p.y()};
  }
  return points;
}

void MovingObstacles::set_params(const MovingObstacleParams& params) {
  params_ = params;
  sources_.clear();
  if (!params.enabled) reported_.clear();
}

void MovingObstacles::add_scan(const std::string& source, double stamp_s, const ScanPoints& scan) {
  if (!params_.enabled) return;
  const auto at = sources_
                      .try_emplace(source, Source{ScanClusterer(params_.clusters),
                                                  ObstacleTracker(params_.tracker), stamp_s})
                      .first;
  at->second.tracker.update(at->second.clusterer.cluster(scan), stamp_s, &scan);
  at->second.stamp_s = stamp_s;
}

void MovingObstacles::set_reported(Tracks tracks, double stamp_s) {
  if (!params_.enabled) return;
  reported_ = std::move(tracks);
  reported_s_ = stamp_s;
}

Tracks MovingObstacles::at(double time_s) {
  Tracks result;
  const auto count = static_cast<int>(sources_.size()) + 1;
  int place = 0;
  // Each source counts on its own: ids of several are interleaved.
  const auto add = [&](Track track) {
    track.id = track.id * count + place;
    result.push_back(track);
  };
  for (auto& [name, source] : sources_) {
    // A scan may be newer than the robot's state, whose clock is the slower one.
    for (const Track& track : source.tracker.moving_at(std::max(time_s, source.stamp_s))) {
      add(track);
    }
    ++place;
  }
  const double age_s = time_s - reported_s_;
  if (std::fabs(age_s) > params_.report_timeout) return result;
  for (Track track : reported_) {
    track.position = track.position_at(std::max(age_s, 0.0));
    add(track);
  }
  return result;
}

}  // namespace trident::nav
