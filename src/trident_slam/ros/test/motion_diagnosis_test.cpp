// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/motion_diagnosis.h"

#include <gtest/gtest.h>

namespace trident::slam {
namespace {

TEST(MotionDiagnosis, OdometryThatMovesIsNoProblem) {
  const MotionDiagnosis diagnosis = diagnose_motion({});
  EXPECT_EQ(diagnosis.motion_by, "odometry");
  EXPECT_EQ(diagnosis.open, "none");
  EXPECT_EQ(diagnosis.warning, "");
}

TEST(MotionDiagnosis, OdometryThatStandsIsAWarningWhatWasAskedForIsNot) {
  ScanPose2d pose;
  pose.motion_by = MotionBy::kScansAsOdometryStands;
  EXPECT_EQ(diagnose_motion(pose).motion_by, "scans, for odometry stands still");
  EXPECT_NE(diagnose_motion(pose).warning, "");
  pose.motion_by = MotionBy::kScansAsAsked;
  EXPECT_EQ(diagnose_motion(pose).warning, "");
}

TEST(MotionDiagnosis, AnOpenDirectionIsNamedWithItsDeviation) {
  ScanPose2d pose;
  pose.motion_by = MotionBy::kScansAsAsked;
  pose.is_open = true;
  pose.covariance.diagonal() << 1e-4, 0.25, 1e-4;  // a corridor along the map's y
  EXPECT_EQ(diagnose_motion(pose).open, "1.57 rad in the map, standard deviation 0.5 m");
  EXPECT_NE(diagnose_motion(pose).warning.find("a direction open: 1.57 rad"), std::string::npos);
}

}  // namespace
}  // namespace trident::slam
