// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "trident_base/se2.h"

namespace trident {

/// One sweep of a planar laser scanner. Beam i points along `angle_min + i * angle_increment` in
/// the laser's frame (x forward, counter-clockwise positive) and was measured
/// `i * time_increment` after `stamp_ns`. A range that is not finite, or outside
/// [range_min, range_max], is no return.
struct LaserScan {
  std::int64_t stamp_ns = 0;     ///< of the first beam; a label: no algorithm sorts by it
  double angle_min = 0.0;        ///< [rad]
  double angle_increment = 0.0;  ///< [rad], may be negative
  double time_increment = 0.0;   ///< [s] between beams; 0: all at once
  double range_min = 0.0;        ///< [m]
  double range_max = 0.0;        ///< [m]
  /// Mean turning rate of the robot during the sweep, where a gyro measured it [rad/s].
  std::optional<double> yaw_rate;
  SE2 T_base_laser;           ///< where the laser sits on the robot
  std::vector<float> ranges;  ///< [m]

  std::size_t size() const { return ranges.size(); }  ///< beams, returns or not
  /// Direction of a beam in the laser's frame [rad], not wrapped.
  double angle(std::size_t beam) const {
    return angle_min + static_cast<double>(beam) * angle_increment;
  }
  /// False for NaN, too.
  bool is_return(std::size_t beam) const {
    return ranges[beam] >= range_min && ranges[beam] <= range_max;
  }
};

}  // namespace trident
