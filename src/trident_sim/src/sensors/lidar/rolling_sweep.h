// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "trident_base/se3.h"
#include "trident_sim/plugin.h"
#include "trident_sim/state_archive.h"

namespace trident::sim {

/// Where a sensor is within a step, between its poses as the step begins and ends: at a constant
/// velocity and rate.
class SensorTrack {
 public:
  /// To be called once a step with the newest pose; the first time there is no earlier one.
  void follow(const SE3& T_world_sensor) {
    T_world_begin_ = has_pose_ ? T_world_end_ : T_world_sensor;
    T_world_end_ = T_world_sensor;
    has_pose_ = true;
    is_still_ =
        T_world_begin_.p == T_world_end_.p && T_world_begin_.R.coeffs() == T_world_end_.R.coeffs();
    const Eigen::AngleAxisd turn(T_world_begin_.R.conjugate() * T_world_end_.R);
    axis_ = turn.axis();
    half_angle_ = 0.5 * turn.angle();
  }
  bool is_still() const { return is_still_; }
  /// `fraction` of the step is over, in [0, 1].
  SE3 at(double fraction) const {
    if (is_still_) return T_world_end_;
    const double half = fraction * half_angle_;
    Eigen::Quaterniond turn;
    turn.w() = std::cos(half);
    turn.vec() = std::sin(half) * axis_;
    return {T_world_begin_.R * turn,
            T_world_begin_.p + fraction * (T_world_end_.p - T_world_begin_.p)};
  }
  void reset() { has_pose_ = false; }
  void state(StateArchive& archive) { archive(T_world_end_, has_pose_); }

 private:
  SE3 T_world_begin_, T_world_end_;
  Eigen::Vector3d axis_ = Eigen::Vector3d::UnitX();
  double half_angle_ = 0.0;
  bool has_pose_ = false, is_still_ = true;
};

/// Which columns of a rolling scan fall due as time passes. Scan k begins k / rate after the last
/// reset, and its columns follow each other at their period.
class RollingSweep {
 public:
  RollingSweep(double rate_hz, std::size_t columns, double column_period_s)
      : rate_hz_(rate_hz), columns_(columns), column_period_s_(column_period_s) {}

  /// Columns [first, last) of a scan.
  struct Due {
    std::uint64_t scan = 0;
    std::size_t first = 0, last = 0;
    bool is_complete = false;  ///< the scan ends with them
  };

  /// To be called once a step. Nothing is due while nobody wants it; then the next scan is the
  /// first to be cast.
  void begin_step(const StepInfo& info, bool is_wanted) {
    begin_s_ = static_cast<double>(info.dt.ns * (info.sample - 1)) / 1e9;
    end_s_ = static_cast<double>(info.dt.ns * info.sample) / 1e9;
    zero_ns_ = info.end.ns - info.dt.ns * static_cast<std::int64_t>(info.sample);
    if (is_wanted && !is_sweeping_) {
      scan_ = static_cast<std::uint64_t>(std::max(std::ceil(begin_s_ * rate_hz_ - kSame), 0.0));
      next_ = 0;
    }
    is_sweeping_ = is_wanted;
  }
  /// What is due next in this step; none: no more.
  std::optional<Due> next() {
    const double since_s = end_s_ + kSame - static_cast<double>(scan_) / rate_hz_;
    if (!is_sweeping_ || since_s < 0.0) return std::nullopt;
    const double over = column_period_s_ > 0.0 ? std::floor(since_s / column_period_s_) + 1.0
                                               : static_cast<double>(columns_);
    const std::size_t last = over < static_cast<double>(columns_)
                                 ? std::max(next_, static_cast<std::size_t>(over))
                                 : columns_;
    if (last == next_) return std::nullopt;
    const Due due{scan_, next_, last, last == columns_};
    next_ = due.is_complete ? 0 : last;
    if (due.is_complete) ++scan_;
    return due;
  }
  /// How much of the step is over `after_s` after a column begins.
  double fraction(const Due& due, std::size_t column, double after_s) const {
    const double time_s = static_cast<double>(due.scan) / rate_hz_ +
                          static_cast<double>(column) * column_period_s_ + after_s;
    return std::clamp((time_s - begin_s_) / (end_s_ - begin_s_), 0.0, 1.0);
  }
  SimTime stamp(const Due& due) const {
    return SimTime{zero_ns_} + SimTime::from_seconds(static_cast<double>(due.scan) / rate_hz_);
  }
  void reset() { is_sweeping_ = false; }
  void state(StateArchive& archive) { archive(scan_, next_, is_sweeping_); }

 private:
  static constexpr double kSame = 1e-9;

  double rate_hz_;
  std::size_t columns_;
  double column_period_s_;
  std::uint64_t scan_ = 0;
  std::size_t next_ = 0;  ///< column of it
  bool is_sweeping_ = false;
  double begin_s_ = 0.0, end_s_ = 0.0;  ///< of the step, since the last reset
  std::int64_t zero_ns_ = 0;            ///< the last reset
};

}  // namespace trident::sim
