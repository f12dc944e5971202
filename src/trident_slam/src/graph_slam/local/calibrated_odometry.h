// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "motion/odometry_calibration.h"
#include "trident_slam/graph_slam_front_end.h"
#include "trident_slam/match_result.h"
#include "trident_slam/slam_2d_capabilities.h"

namespace trident::slam {

/// Odometry of a mapper that learns from its own matches what is wrong with it.
class CalibratedOdometry {
 public:
  /// `is_applied` false: parameters are estimated, but motions stay those of odometry.
  explicit CalibratedOdometry(bool is_applied, const CalibrationOptions& options = {})
      : is_applied_(is_applied), options_(options) {}

  /// The motion since the last scan, by odometry, corrected.
  SE2 calibrated(const SE2& T_last_base) {
    T_last_base_ = T_last_base;
    return is_applied_ && calibration_ ? calibration_->calibrated(T_last_base) : T_last_base;
  }
  /// The scan was matched: that motion by the map. A match that is poor, or that leaves a
  /// direction open, interrupts.
  void learn(const SE2& T_base_laser, const SE2& T_last_base_seen, const MatchResult& match);
  /// The next motion is not to be learnt from: it begins where nothing was matched.
  void interrupt() {
    if (calibration_) calibration_->interrupt();
  }
  std::vector<CalibrationEstimate> estimates() const;
  /// Of the error per distance that is configured for odometry, the fraction that is left: less
  /// once scale and drift have been seen and are corrected.
  double noise_fraction() const;

 private:
  bool is_applied_;
  CalibrationOptions options_;
  SE2 T_last_base_;  ///< as odometry reported it
  SE2 T_base_laser_;
  std::optional<OdometryCalibration> calibration_;
};

}  // namespace trident::slam
