// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trident_slam/slam_2d.h"

namespace trident::slam {

/// What /diagnostics says of the motion that led to a pose.
struct MotionDiagnosis {
  std::string motion_by;  ///< odometry, or why not
  std::string open;       ///< "none", or the direction that scans leave open, and how far
  std::string warning;    ///< empty, or what a user should know
};
/// Texts for /diagnostics; no state, so that it can be called for any scan.
MotionDiagnosis diagnose_motion(const ScanPose2d& pose);

}  // namespace trident::slam
