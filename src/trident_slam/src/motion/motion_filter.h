// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_base/se2.h"

namespace trident::slam {

/// After how much motion a scan adds something new.
struct MotionFilterOptions {
  double distance = 0.3;  ///< [m]
  double heading = 0.3;   ///< [rad]
  double period = -1.0;   ///< [s] after which a scan is due even without motion; negative: never
};

/// Selects the scans to use: those that were taken far enough, turned enough or long enough after
/// the last one that was used. Who asks keeps that scan's pose, since optimisation may move it.
class MotionFilter {
 public:
  explicit MotionFilter(const MotionFilterOptions& options) : options_(options) {}

  /// `T_last_now`: motion since the last scan that was used; `seconds`: the time since.
  bool is_due(const SE2& T_last_now, double seconds = 0.0) const {
    return is_due(T_last_now.p.norm(), T_last_now.angle, seconds);
  }
  /// The same for a distance [m] and a rotation [rad] of either sign. What is not a number is not
  /// due.
  bool is_due(double meters, double radians, double seconds = 0.0) const;

 private:
  MotionFilterOptions options_;
};

}  // namespace trident::slam
