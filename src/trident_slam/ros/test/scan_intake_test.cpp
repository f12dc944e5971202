// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/scan_intake.h"

#include <gtest/gtest.h>

#include <atomic>
#include <boost/make_shared.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <thread>

#include "trident_base/error.h"

namespace trident::slam {
namespace {

class ScanIntakeTest : public testing::Test {
 protected:
  ScanIntakeTest() {
    geometry_msgs::TransformStamped mount = transform("base_footprint", "laser", 0.0);
    mount.transform.translation.x = 0.2;
    transforms_.setTransform(mount, "test", true);
  }

  static geometry_msgs::TransformStamped transform(const std::string& parent,
                                                   const std::string& child, double stamp_s) {
    geometry_msgs::TransformStamped result;
    result.header.frame_id = parent;
    result.header.stamp.fromSec(stamp_s);
    result.child_frame_id = child;
    result.transform.rotation.w = 1.0;
    return result;
  }
  void odometry(double stamp_s, double x) {
    geometry_msgs::TransformStamped message = transform("odom", "base_footprint", stamp_s);
    message.transform.translation.x = x;
    transforms_.setTransform(message, "test", false);
  }
  static sensor_msgs::LaserScan scan(double stamp_s) {
    sensor_msgs::LaserScan message;
    message.header.frame_id = "laser";
    message.header.stamp.fromSec(stamp_s);
    message.angle_min = -1.0F;
    message.angle_increment = 0.1F;
    message.range_max = 10.0F;
    message.ranges.assign(21, 3.0F);
    return message;
  }
  void add(const sensor_msgs::LaserScan& message) {
    intake_.add(boost::make_shared<sensor_msgs::LaserScan>(message));
  }

  tf2::BufferCore transforms_;
  ScanIntake intake_{ScanIntakeOptions(), transforms_};
};

TEST_F(ScanIntakeTest, AScanWaitsForItsTransformAndGetsThePoseOfItsStamp) {
  odometry(10.0, 1.0);
  add(scan(10.1));
  EXPECT_TRUE(intake_.take().empty());
  EXPECT_EQ(intake_.waiting(), 1U);
  odometry(10.2, 3.0);
  const auto records = intake_.take();
  ASSERT_EQ(records.size(), 1U);
  EXPECT_NEAR(records[0].T_odom_base.p.x(), 2.0, 1e-6);
  EXPECT_NEAR(records[0].scan.T_base_laser.p.x(), 0.2, 1e-6);
  EXPECT_EQ(intake_.problems().count(), 0U);
}

// Transforms come in a thread of their own: one that was there is not, a moment later, when its
// frame got another parent.
TEST_F(ScanIntakeTest, FramesThatChangeTheirParentsMeanwhileEndNothing) {
  ScanIntakeOptions options;
  options.waits_for_all = true;
  ScanIntake intake(options, transforms_);
  std::atomic<bool> is_over{false};
  std::thread others([&] {
    for (int k = 1; !is_over; ++k) {
      odometry(k, 1.0);
      transforms_.setTransform(transform("elsewhere", "base_footprint", k + 0.5), "test", false);
    }
  });
  for (int i = 0; i < 20000; ++i) {
    intake.add(boost::make_shared<sensor_msgs::LaserScan>(scan(1e9)));
    EXPECT_NO_THROW(intake.take());
    intake.clear();
  }
  is_over = true;
  others.join();
}

TEST_F(ScanIntakeTest, WithoutAnOdometryFrameNoneIsWaitedFor) {
  ScanIntakeOptions options;
  options.odom_frame = "";
  ScanIntake intake(options, transforms_);
  intake.add(boost::make_shared<sensor_msgs::LaserScan>(scan(10.1)));
  const auto records = intake.take();
  ASSERT_EQ(records.size(), 1U);
  EXPECT_EQ(records[0].T_odom_base.p, Eigen::Vector2d(0.0, 0.0));
  EXPECT_NEAR(records[0].scan.T_base_laser.p.x(), 0.2, 1e-6);
  EXPECT_EQ(intake.problems().count(), 0U);
}

TEST_F(ScanIntakeTest, SaysWhichTransformIsLateAndByHowMuch) {
  odometry(10.0, 1.0);
  add(scan(10.1));
  add(scan(10.5));  // shows that 0.4 s have passed
  EXPECT_TRUE(intake_.take().empty());
  EXPECT_EQ(intake_.problems().count(), 1U);
  EXPECT_EQ(intake_.last_problem(),
            "scan of 10.100 s is left out: transform odom -> base_footprint is late: the newest is "
            "0.1 s older than the scan");
  EXPECT_EQ(intake_.waiting(), 1U);
}

TEST_F(ScanIntakeTest, SaysWhenAFrameIsNotKnownAtAll) {
  odometry(10.0, 1.0);
  odometry(11.0, 1.0);
  sensor_msgs::LaserScan other = scan(10.1);
  other.header.frame_id = "rear_laser";
  add(other);
  add(scan(10.6));
  EXPECT_EQ(intake_.take().size(), 1U);
  EXPECT_NE(
      intake_.last_problem().find("transform base_footprint -> rear_laser is not known at all"),
      std::string::npos)
      << intake_.last_problem();
}

TEST_F(ScanIntakeTest, SaysWhenATransformIsForgottenAlready) {
  odometry(100.0, 1.0);
  odometry(101.0, 1.0);
  add(scan(10.0));
  add(scan(10.3));
  intake_.take();
  EXPECT_NE(
      intake_.last_problem().find("is not known that far back: the oldest is 90 s younger than"),
      std::string::npos)
      << intake_.last_problem();
}

TEST_F(ScanIntakeTest, TimesInProblemsHaveThreeDigits) {
  odometry(100.0 + 1.0 / 70.0, 1.0);
  add(scan(100.0));
  add(scan(100.3));
  intake_.take();
  EXPECT_NE(intake_.last_problem().find("the oldest is 0.0143 s younger than the scan"),
            std::string::npos)
      << intake_.last_problem();
}

TEST_F(ScanIntakeTest, WaitsForEverScanWhenNoneMayBeLost) {
  ScanIntakeOptions options;
  options.waits_for_all = true;
  ScanIntake patient(options, transforms_);
  odometry(10.0, 1.0);
  for (const double stamp : {10.1, 15.0}) {
    patient.add(boost::make_shared<sensor_msgs::LaserScan>(scan(stamp)));
  }
  EXPECT_TRUE(patient.take().empty());
  odometry(15.0, 1.0);
  EXPECT_EQ(patient.take().size(), 2U);
  patient.add(boost::make_shared<sensor_msgs::LaserScan>(scan(16.0)));
  patient.end();
  EXPECT_EQ(patient.problems().count(), 1U);
  EXPECT_EQ(patient.waiting(), 0U);
}

TEST_F(ScanIntakeTest, ALaserUpsideDownTurnsInTheOtherDirection) {
  geometry_msgs::Transform mount;
  mount.rotation.x = 1.0;  // half a turn about x
  mount.rotation.w = 0.0;
  const LaserScan turned = to_laser_scan(scan(1.0), mount);
  EXPECT_NEAR(turned.angle_min, 1.0, 1e-6);
  EXPECT_NEAR(turned.angle_increment, -0.1, 1e-6);
}

TEST_F(ScanIntakeTest, BadMessagesAreOneErrorEach) {
  geometry_msgs::Transform level;
  level.rotation.w = 1.0;
  const auto problem_of = [&](const sensor_msgs::LaserScan& message,
                              const geometry_msgs::Transform& mount) {
    try {
      to_laser_scan(message, mount);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  sensor_msgs::LaserScan bad = scan(1.0);
  bad.ranges.clear();
  EXPECT_EQ(problem_of(bad, level), "ranges: no beam, legal: at least 1");
  bad = scan(1.0);
  bad.angle_increment = 0.0F;
  EXPECT_EQ(problem_of(bad, level), "angle_increment 0 rad, legal: not 0");
  bad.angle_increment = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(problem_of(bad, level), "");
  bad = scan(1.0);
  bad.range_max = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(problem_of(bad, level).find("range_max nan m, legal"), std::string::npos);
  geometry_msgs::Transform tilted;
  tilted.rotation.w = tilted.rotation.y = std::sqrt(0.5);
  EXPECT_EQ(problem_of(scan(1.0), tilted),
            "frame laser is tilted by 90 deg, legal: a laser that looks around in the plane");
  // NaN, infinite and zero ranges are no returns; whether enough are left is the algorithm's.
  bad = scan(1.0);
  bad.ranges = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                0.0F, 3.0F};
  const LaserScan good = to_laser_scan(bad, level);
  EXPECT_FALSE(good.is_return(0));
  EXPECT_FALSE(good.is_return(1));
  EXPECT_TRUE(good.is_return(3));
}

TEST_F(ScanIntakeTest, AScanThatNoTransformCouldMakeUsefulIsRefusedAtOnce) {
  odometry(10.0, 1.0);
  odometry(20.0, 2.0);
  add(scan(4e9));
  EXPECT_NE(intake_.last_problem().find("legal: below 2147000000 s"), std::string::npos);
  sensor_msgs::LaserScan message = scan(10.0);
  message.header.frame_id = "";
  add(message);
  EXPECT_NE(intake_.last_problem().find("frame_id is ''"), std::string::npos);
  EXPECT_EQ(intake_.waiting(), 0U);
  EXPECT_EQ(intake_.left_out(), 2U);
  EXPECT_FALSE(intake_.is_refused(scan(11.0), ros::Time(10, 0)));
  EXPECT_TRUE(intake_.is_refused(scan(11.0 + 86400.0), ros::Time(10, 0)));
}

TEST_F(ScanIntakeTest, ASweepOfAges) {
  odometry(10.0, 1.0);
  odometry(20.0, 2.0);
  sensor_msgs::LaserScan message = scan(11.0);
  message.time_increment = 1e30F;
  add(message);
  EXPECT_TRUE(intake_.take().empty());
  EXPECT_NE(intake_.last_problem().find("time_increment"), std::string::npos);
}

TEST_F(ScanIntakeTest, WhatIsAheadOfTheOthersDoesNotHoldThemUp) {
  odometry(10.0, 1.0);
  odometry(20.0, 2.0);
  add(scan(5000.0));
  add(scan(11.0));
  EXPECT_TRUE(intake_.take().empty());
  intake_.leave_out_after(ros::Time(11, 0), "ahead");
  EXPECT_EQ(intake_.take().size(), 1U);
}

}  // namespace
}  // namespace trident::slam
