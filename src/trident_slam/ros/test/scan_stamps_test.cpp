// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/scan_stamps.h"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>
#include <vector>

namespace trident::slam {
namespace {

class ScanStampsTest : public testing::Test {
 protected:
  ScanStamps::Step add(double stamp_s) {
    const auto message = boost::make_shared<sensor_msgs::LaserScan>();
    message->header.stamp.fromSec(stamp_s);
    ScanStamps::Step step = stamps_.add(message);
    for (const auto& scan : step.scans) taken_.push_back(scan->header.stamp.toSec());
    return step;
  }

  ScanStamps stamps_{1.0};
  std::vector<double> taken_;
};

TEST_F(ScanStampsTest, WhatIsALittleOlderIsAScanLikeOthers) {
  for (const double stamp_s : {10.0, 10.5, 9.8, 11.0}) EXPECT_EQ(add(stamp_s).problem, "");
  EXPECT_EQ(taken_, (std::vector<double>{10.0, 10.5, 9.8, 11.0}));
}

TEST_F(ScanStampsTest, ABagThatBeginsAgainLosesNoScan) {
  for (const double stamp_s : {10.0, 20.0, 30.0}) add(stamp_s);
  EXPECT_TRUE(add(10.0).scans.empty());
  const ScanStamps::Step step = add(10.1);
  ASSERT_TRUE(step.went_back);
  EXPECT_DOUBLE_EQ(step.went_back->toSec(), 20.0);
  EXPECT_DOUBLE_EQ(step.back_from->toSec(), 30.0);
  EXPECT_EQ(taken_, (std::vector<double>{10.0, 20.0, 30.0, 10.0, 10.1}));
  EXPECT_FALSE(add(10.2).went_back);
}

TEST_F(ScanStampsTest, ASingleStampOfZeroIsNotTheBeginningOfABag) {
  add(1000.0);
  EXPECT_TRUE(add(0.0).scans.empty());
  const ScanStamps::Step step = add(1000.1);
  EXPECT_FALSE(step.went_back);
  EXPECT_EQ(step.problem, "scan is left out: its stamp is 1000 s before those about it");
  EXPECT_EQ(taken_, (std::vector<double>{1000.0, 1000.1}));
}

TEST_F(ScanStampsTest, ASingleStampFarAheadIsNotTheEndOfAllOthers) {
  add(1000.0);
  add(5000.0);  // a pause of the recording, for all that is known
  const ScanStamps::Step step = add(1000.1);
  EXPECT_FALSE(step.went_back);
  EXPECT_TRUE(step.was_ahead);
  EXPECT_EQ(step.problem, "scan is left out: its stamp is 3999.9 s after those about it");
  EXPECT_EQ(add(1000.2).problem, "");
  EXPECT_EQ(taken_.back(), 1000.2);
}

TEST_F(ScanStampsTest, APauseOfTheRecordingIsOne) {
  for (const double stamp_s : {1000.0, 5000.0, 5000.1}) add(stamp_s);
  EXPECT_TRUE(add(1000.1).scans.empty());
  EXPECT_TRUE(add(1000.2).went_back);
}

}  // namespace
}  // namespace trident::slam
