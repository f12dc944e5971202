// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <optional>

#include "trident_base/laser_scan.h"

namespace trident::slam {

/// From the first beam to the last [s].
double sweep_duration(const LaserScan& scan);

/// The base's motion (vx, vy [m/s], w [rad/s]) while a sweep was taken, for `make_point_scan`:
/// that of odometry since the sweep before, `seconds` ago, with the turning rate of a gyro where
/// the scan has one. Zero for a scan whose beams come all at once; a motion over more than a second
/// says little about now and counts as none, as does one faster than 100 m/s or rad/s: stamps lie.
Eigen::Vector3d sweep_twist(const LaserScan& scan, const SE2& T_before_now, double seconds);

/// The turning rates of a gyro, about the base's upward axis, by their stamps.
class YawRates {
 public:
  /// A rate that is not finite or above 100 rad/s, or not younger than the one before, is left out:
  /// false. A stamp that goes back by more than a second (a bag that is played again) starts again.
  bool add(std::int64_t stamp_ns, double yaw_rate);
  void clear() { samples_.clear(); }  ///< no rates are known

  /// Mean over a time, rates between samples interpolated. Nothing where the samples do not reach
  /// from its beginning to its end, or leave a gap of more than 0.1 s in it. A sample suffices
  /// for a time of no length.
  std::optional<double> mean(std::int64_t from_ns, std::int64_t to_ns) const;
  /// Stamp of the newest rate; nothing before the first one.
  std::optional<std::int64_t> newest_ns() const;

 private:
  struct Sample {
    std::int64_t stamp_ns = 0;
    double rate = 0.0;  ///< [rad/s]
  };
  bool covers(std::int64_t from_ns, std::int64_t to_ns) const;
  std::size_t not_before(std::int64_t stamp_ns) const;
  bool has_gap(std::int64_t from_ns, std::int64_t to_ns) const;
  double rate_at(std::size_t after, std::int64_t stamp_ns) const;

  std::deque<Sample> samples_;  ///< of the last ten seconds
};

}  // namespace trident::slam
