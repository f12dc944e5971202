// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "trident_base/se2.h"
#include "trident_slam/ekf_slam.h"

namespace trident::slam {

/// One pose of a landmark log: how the robot came there and what it saw there.
struct LandmarkLogStep {
  int pose_id = 0;                                       ///< as in the file
  SE2 T_before_now;                                      ///< from the step before; identity first
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x, y, yaw) of that motion
  std::vector<PointObservation> observations;            ///< made at the end of the step
  std::vector<int> ids;  ///< the file's answer to which landmark each was
};

/// Reads the text form in which GTSAM keeps Victoria Park:
///   ODOMETRY from to dx dy dyaw  xx xy xw yy yw ww    (upper triangle of the covariance)
///   LANDMARK pose landmark x y   xx xy yy             (in the frame of the pose)
/// in the order of driving; `pose` is the `to` of the latest ODOMETRY (or the first `from`). Blank
/// lines and those that begin with '#' are skipped. Throws Error naming file, line and field.
std::vector<LandmarkLogStep> read_landmark_log(const std::string& file);

/// How well the filter's data association agrees with the file's.
struct AssociationScore {
  int observations = 0;  ///< in the log
  int unused = 0;        ///< ambiguous to the filter
  int correct = 0;  ///< its landmark is the one that its true landmark is mostly seen as, and back
  int true_landmarks = 0;   ///< that the file has
  int found_landmarks = 0;  ///< of the filter, seen in this log

  /// Of the observations that the filter used; 0 when it used none.
  double correct_share() const {
    return observations == unused ? 0.0 : static_cast<double>(correct) / (observations - unused);
  }
};

/// `found[k][i]`: what EkfSlam::observe returned for observation i of steps[k].
AssociationScore score_association(const std::vector<LandmarkLogStep>& steps,
                                   const std::vector<std::vector<int>>& found);

}  // namespace trident::slam
