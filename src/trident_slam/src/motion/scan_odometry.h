// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <memory>

#include "grids/max_pyramid.h"
#include "matchers/line_match.h"
#include "scan_motion.h"

namespace trident::slam {

/// How the base moved from one scan to the next, as measured by scans.
struct ScanStep {
  SE2 T_before_now;
  /// Of (x [m], y [m], yaw [rad]) of that motion, in the base's frame before it.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  bool is_sure = true;   ///< false: the scans do not fit to each other, it is what was expected
  bool is_open = false;  ///< the surroundings leave a direction open (a corridor)
};

/// Odometry by scans alone: each scan is matched with a few that were taken shortly before it, a
/// little distance apart. While the robot stands they stay the same, so that it does not creep;
/// they are not blurred by what a map has gathered over time, so that in a corridor even small
/// features count.
class ScanOdometry {
 public:
  /// The next scan, and where it is expected to be.
  ScanStep track(const std::shared_ptr<const PointScan>& scan, const ExpectedMotion& expected);
  /// A scan that shows nothing: the base has moved like this.
  void coast(const SE2& T_before_now);
  /// The motion up to the newest scan as it was believed in the end, by the map. Motions are
  /// counted from where the map put the scans that the next one is matched with.
  void settle(const SE2& T_before_now);
  void forget() { *this = ScanOdometry(); }

 private:
  struct Placed {
    SE2 T_local_base;
    std::shared_ptr<const PointScan> scan;
  };
  void keep(const std::shared_ptr<const PointScan>& scan);
  MaxPyramid recent_hits() const;
  MatchResult match(const PointScan& scan, const ExpectedMotion& expected) const;

  std::deque<Placed> recent_;
  SurfelMap surfels_;
  SE2 T_local_base_;
  SE2 T_kept_base_;  ///< since the newest scan that was kept, as the map has it
  bool is_newest_kept_ = false;
};

}  // namespace trident::slam
