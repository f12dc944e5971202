// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "odometry_motion.h"
#include "odometry_watch.h"
#include "scan_odometry.h"
#include "trident_slam/slam_2d.h"

namespace trident::slam {

/// The motion between two scans: that of odometry as long as it reports any, else that of the scans
/// themselves. Calls for each scan, in this order: `next`; if the scan shows anything, `measure`;
/// `settle`.
class MotionSource {
 public:
  using Step = OdometryMotion::Step;

  /// `uses_odometry` false: the scans' motion from the start.
  MotionSource(bool uses_odometry, const OdometryMotion& odometry)
      : uses_odometry_(uses_odometry), odometry_(odometry) {}

  /// What is known of the motion before the scan is looked at: what odometry reports, or what the
  /// robot is expected to do.
  Step next(std::int64_t stamp_ns, const SE2& T_odom_base);
  /// Where scans replace odometry: matches the scan.
  void measure(const std::shared_ptr<const PointScan>& scan, Step* step);
  /// The motion as it was believed in the end. `is_shown` false: the scan showed nothing of it.
  /// Returns what the user should know about odometry, usually nothing.
  std::string settle(const SE2& T_before_now, bool is_shown);

  bool is_by_scans() const { return !uses_odometry_ || watch_.is_silent(); }
  /// Odometry is asked, but says nothing.
  bool is_silent() const { return uses_odometry_ && watch_.is_silent(); }
  MotionBy motion_by() const {
    if (!uses_odometry_) return MotionBy::kScansAsAsked;
    return watch_.is_silent() ? MotionBy::kScansAsOdometryStands : MotionBy::kOdometry;
  }
  /// The motion that `measure` found last.
  const ScanStep& scan_step() const { return scan_step_; }
  /// The next pose of odometry is the first one again.
  void forget_odometry() { odometry_.forget(); }
  void set_uses_odometry(bool uses_odometry) { uses_odometry_ = uses_odometry; }

 private:
  void settle_by_scans(const SE2& T_before_now);
  std::string change_of_odometry(bool was_silent) const;

  bool uses_odometry_;
  OdometryMotion odometry_;
  OdometryWatch watch_;
  ScanMotion motion_;
  ScanOdometry scan_odometry_;
  ScanStep scan_step_;
  std::shared_ptr<const PointScan> newest_;
  std::int64_t stamp_ns_ = 0;
  SE2 T_reported_;  ///< by odometry, since the last scan
};

}  // namespace trident::slam
