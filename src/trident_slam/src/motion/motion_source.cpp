// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "motion_source.h"

#include <cmath>

#include "trident_base/string_util.h"

namespace trident::slam {
namespace {

std::string rounded(double value) { return number_text(std::round(100.0 * value) / 100.0); }

}  // namespace

MotionSource::Step MotionSource::next(std::int64_t stamp_ns, const SE2& T_odom_base) {
  stamp_ns_ = stamp_ns;
  newest_.reset();
  Step step = uses_odometry_ ? odometry_.next(T_odom_base) : Step();
  T_reported_ = step.T_before_now;
  if (!is_by_scans()) return step;
  const ExpectedMotion expected = motion_.expected(stamp_ns);
  step.T_before_now = expected.T_before_now;
  if (uses_odometry_ && watch_.reports_heading()) step.T_before_now.angle = T_reported_.angle;
  step.by_scans = expected.spread;
  step.is_stale = false;
  return step;
}

void MotionSource::measure(const std::shared_ptr<const PointScan>& scan, Step* step) {
  newest_ = scan;
  if (!step->by_scans) return;
  scan_step_ = scan_odometry_.track(scan, {step->T_before_now, *step->by_scans});
  step->T_before_now = scan_step_.T_before_now;
  const Eigen::Matrix3d& covariance = scan_step_.covariance;
  step->by_scans = MotionSpread{std::sqrt(covariance.topLeftCorner<2, 2>().trace()),
                                std::sqrt(covariance(2, 2))};
}

void MotionSource::settle_by_scans(const SE2& T_before_now) {
  if (newest_ == nullptr) scan_odometry_.coast(T_before_now);
  scan_odometry_.settle(T_before_now);
  motion_.add(stamp_ns_, scan_step_.T_before_now, newest_ != nullptr && scan_step_.is_sure);
}

std::string MotionSource::settle(const SE2& T_before_now, bool is_shown) {
  const bool was_by_scans = is_by_scans();
  const bool was_silent = is_silent();
  if (uses_odometry_) watch_.add(T_reported_, T_before_now, is_shown);
  if (was_by_scans) {
    settle_by_scans(T_before_now);
  } else {
    motion_.add(stamp_ns_, T_before_now, is_shown);
  }
  if (!was_by_scans && is_by_scans()) {  // the next scan is matched with this one
    scan_odometry_.forget();
    if (newest_ != nullptr) scan_odometry_.track(newest_, {});
  }
  return change_of_odometry(was_silent);
}

std::string MotionSource::change_of_odometry(bool was_silent) const {
  if (was_silent == is_silent()) return {};
  if (was_silent) return "odometry moves again: it is believed again";
  return "odometry has stood still for " + std::to_string(watch_.scans()) +
         " scans that moved by " + rounded(watch_.seen_meters()) + " m, " +
         rounded(watch_.seen_radians()) +
         " rad: until it moves, the motion is that of the scans themselves";
}

}  // namespace trident::slam
