// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "ekf_slam/posts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "trident_base/angle.h"

namespace trident::slam {
namespace {

/// One cylinder before a round wall of 8 m.
LaserScan scan_of_post(const Eigen::Vector2d& center, double radius, std::size_t beams = 720) {
  LaserScan scan;
  scan.angle_min = -kPi;
  scan.angle_increment = 2.0 * kPi / static_cast<double>(beams);
  scan.range_min = 0.05;
  scan.range_max = 20.0;
  for (std::size_t i = 0; i < beams; ++i) {
    const Eigen::Vector2d d(std::cos(scan.angle(i)), std::sin(scan.angle(i)));
    const double ahead = center.dot(d);
    const double half2 = radius * radius - (center.squaredNorm() - ahead * ahead);
    scan.ranges.push_back(
        static_cast<float>(ahead > 0.0 && half2 > 0.0 ? ahead - std::sqrt(half2) : 8.0));
  }
  return scan;
}

TEST(Posts, MiddleOfACylinderIsFound) {
  for (const Eigen::Vector2d& center :
       {Eigen::Vector2d(3.0, 1.0), Eigen::Vector2d(-2.0, 0.001), Eigen::Vector2d(0.5, -4.0)}) {
    const auto posts = find_posts(scan_of_post(center, 0.15), {});
    ASSERT_EQ(posts.size(), 1U) << center.transpose();
    EXPECT_LT((posts[0].p_base - center).norm(), 0.03) << center.transpose();
    EXPECT_GT(posts[0].covariance.determinant(), 0.0);
  }
}

TEST(Posts, AreGivenInTheBaseFrame) {
  LaserScan scan = scan_of_post({3.0, 0.0}, 0.15);
  scan.T_base_laser = SE2::from_xy_yaw(0.5, 0.2, kPi / 2.0);
  const auto posts = find_posts(scan, {});
  ASSERT_EQ(posts.size(), 1U);
  EXPECT_LT((posts[0].p_base - Eigen::Vector2d(0.5, 3.2)).norm(), 0.03);
}

TEST(Posts, WallsWideObjectsAndSpecksAreNone) {
  EXPECT_TRUE(find_posts(scan_of_post({3.0, 0.0}, 0.6), {}).empty());   // too wide
  EXPECT_TRUE(find_posts(scan_of_post({7.8, 0.0}, 0.1), {}).empty());   // stands at the wall
  EXPECT_TRUE(find_posts(scan_of_post({50.0, 0.0}, 0.1), {}).empty());  // behind it
  LaserScan speck = scan_of_post({50.0, 0.0}, 0.1);
  speck.ranges[100] = 2.0F;
  EXPECT_TRUE(find_posts(speck, {}).empty());
}

TEST(Posts, WhatABadBeamBordersIsNotBelieved) {
  LaserScan scan = scan_of_post({3.0, 0.0}, 0.15);
  std::size_t first = 0;
  while (scan.ranges[first] > 7.0F) ++first;
  scan.ranges[first - 1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(find_posts(scan, {}).empty());
}

}  // namespace
}  // namespace trident::slam
