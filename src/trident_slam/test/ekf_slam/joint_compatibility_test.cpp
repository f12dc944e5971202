// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "ekf_slam/joint_compatibility.h"

#include <gtest/gtest.h>

#include <limits>

namespace trident::slam {
namespace {

const std::vector<double> kGates = {0.0, 9.21, 13.28, 16.81, 20.09};  // 99 % of 2, 4, 6, 8 degrees

LandmarkPair make_pair(std::size_t observed, std::size_t landmark, double x, double y = 0.0) {
  LandmarkPair pair;
  pair.observed = observed;
  pair.landmark = landmark;
  pair.innovation = {x, y};
  pair.H.setZero();
  return pair;
}

/// The whole team of observations may be shifted by up to meters, each alone by centimetres.
Eigen::Matrix2d shifted_together(const LandmarkPair& a, const LandmarkPair& b) {
  const double own = a.observed == b.observed ? 0.01 : 0.0;
  return (1.0 + own) * Eigen::Matrix2d::Identity();
}

TEST(JointCompatibility, TakesTheSetThatIsShiftedAsOne) {
  // Landmark 1 is nearest to observation 0, but only 0-0 and 1-1 are off by the same metre.
  const std::vector<std::vector<LandmarkPair>> candidates = {
      {make_pair(0, 1, -0.1), make_pair(0, 0, 1.0)},
      {make_pair(1, 1, 1.02), make_pair(1, 2, -1.0)}};
  const auto pairs = largest_joint_set(candidates, kGates, shifted_together, 1000);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].landmark, 0U);
  EXPECT_EQ(pairs[1].landmark, 1U);
}

TEST(JointCompatibility, LeavesOutWhatFitsAloneButNotWithTheOthers) {
  const std::vector<std::vector<LandmarkPair>> candidates = {
      {make_pair(0, 0, 1.0)}, {make_pair(1, 1, -1.5)}, {make_pair(2, 2, 1.05)}};
  const auto pairs = largest_joint_set(candidates, kGates, shifted_together, 1000);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].observed, 0U);
  EXPECT_EQ(pairs[1].observed, 2U);
}

TEST(JointCompatibility, OneLandmarkIsSeenOnce) {
  const std::vector<std::vector<LandmarkPair>> candidates = {{make_pair(0, 0, 0.3)},
                                                             {make_pair(1, 0, 0.2)}};
  const auto pairs = largest_joint_set(candidates, kGates, shifted_together, 1000);
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].observed, 1U);  // of two sets of one, the nearer
}

TEST(JointCompatibility, ABudgetThatEndsStillGivesASet) {
  std::vector<std::vector<LandmarkPair>> candidates(4);
  for (std::size_t i = 0; i < 4; ++i) candidates[i].push_back(make_pair(i, i, 0.0));
  EXPECT_EQ(largest_joint_set(candidates, kGates, shifted_together, 2).size(), 2U);
  EXPECT_TRUE(largest_joint_set({}, kGates, shifted_together, 2).empty());
}

TEST(JointCompatibility, ACovarianceThatIsNoneIsNoPair) {
  const auto broken = [](const LandmarkPair&, const LandmarkPair&) -> Eigen::Matrix2d {
    return Eigen::Matrix2d::Constant(std::numeric_limits<double>::quiet_NaN());
  };
  EXPECT_TRUE(largest_joint_set({{make_pair(0, 0, 0.0)}}, kGates, broken, 10).empty());
}

}  // namespace
}  // namespace trident::slam
