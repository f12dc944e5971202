// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "trident_base/se2.h"

namespace trident::slam {

/// Standard deviations of a motion between two scans.
struct MotionSpread {
  double s_p = 0.0;    ///< [m]
  double s_yaw = 0.0;  ///< [rad]
};

/// The motion between two scans as odometry reports it, or none where odometry cannot be believed.
class OdometryMotion {
 public:
  /// Farther [m], or turned more [rad], between two scans is a jump.
  explicit OdometryMotion(double jump_distance = 3.0, double jump_heading = 2.5)
      : jump_distance_(jump_distance), jump_heading_(jump_heading) {}

  struct Step {
    SE2 T_before_now;     ///< identity for the first scan and where there is a problem
    std::string problem;  ///< empty, or what is wrong, with values and what is legal
    /// The very same pose as before. It may lag behind: some drivers repeat the latest one that
    /// they have, and report all that was missed in one step.
    bool is_stale = false;
    /// Of a motion measured by scans because odometry reports none (`MotionSource`).
    std::optional<MotionSpread> by_scans;
  };
  Step next(const SE2& T_odom_base);
  /// The next pose is the first one again.
  void forget() { T_odom_base_.reset(); }

 private:
  Step step_between(const SE2& T_odom_before, const SE2& T_odom_now) const;

  double jump_distance_;
  double jump_heading_;
  std::optional<SE2> T_odom_base_;  ///< the latest that was a number
};

}  // namespace trident::slam
