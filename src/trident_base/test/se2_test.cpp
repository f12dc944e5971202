// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/se2.h"

#include <gtest/gtest.h>

#include <limits>

#include "is_near.h"
#include "trident_base/angle.h"

namespace trident {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::uint64_t kCases = 100;

Vector3d tangent(std::uint64_t i) {
  return random_vector<3>(i, 1.0).cwiseProduct(Vector3d(20.0, 20.0, kPi));
}

TEST(Angle, WrapsIntoTheHalfOpenInterval) {
  EXPECT_DOUBLE_EQ(wrap_to_pi(3 * kPi / 2), -kPi / 2);
  EXPECT_DOUBLE_EQ(wrap_to_pi(-3 * kPi / 2), kPi / 2);
  EXPECT_EQ(wrap_to_pi(kPi), kPi);
  EXPECT_EQ(wrap_to_pi(-kPi), kPi);
  EXPECT_EQ(wrap_to_pi(0.25), 0.25);
  EXPECT_NEAR(wrap_to_pi(0.25 + 200 * kPi), 0.25, 1e-12);
}

TEST(Angle, DifferenceIsTheShorterRotation) {
  EXPECT_NEAR(angle_difference(deg_to_rad(-179), deg_to_rad(179)), deg_to_rad(2), 1e-15);
  EXPECT_DOUBLE_EQ(rad_to_deg(deg_to_rad(33.0)), 33.0);
}

TEST(Se2, ComposedWithItsInverseIsIdentity) {
  for (std::uint64_t i = 0; i < kCases; ++i) {
    const SE2 T = SE2::exp(tangent(i));
    EXPECT_TRUE(is_near(T * T.inverse(), SE2::identity(), 1e-13));
    EXPECT_TRUE(is_near(T.inverse() * T, SE2::identity(), 1e-13));
  }
}

TEST(Se2, AgreesWithTheSameMotionInSpace) {
  for (std::uint64_t i = 0; i + 1 < kCases; ++i) {
    const Vector3d t = tangent(i);
    Vector6d t_space = Vector6d::Zero();
    t_space.head<2>() = t.head<2>();
    t_space[5] = t[2];
    const SE2 T = SE2::exp(t);
    EXPECT_TRUE(is_near(T.to_se3(), SE3::exp(t_space), 1e-13));
    const SE2 U = SE2::exp(tangent(i + 1));
    EXPECT_TRUE(is_near((T * U).to_se3(), T.to_se3() * U.to_se3(), 1e-13));
    const Vector2d point(t[1], 3.0);
    const Vector3d point_space = T.to_se3() * Vector3d(point.x(), point.y(), 0.0);
    EXPECT_TRUE(is_near(T * point, point_space.head<2>(), 1e-13));
  }
}

TEST(Se2, LogInvertsExp) {
  for (std::uint64_t i = 0; i < kCases; ++i) {
    EXPECT_TRUE(is_near(SE2::exp(tangent(i)).log(), tangent(i), 1e-13));
  }
  for (const double w : {0.0, std::numeric_limits<double>::denorm_min(), 1e-300, 1e-9, 1e-3, kPi}) {
    const Vector3d t(1.0, -2.0, w);
    EXPECT_TRUE(is_near(SE2::exp(t).log(), t, 1e-14)) << w;
  }
}

TEST(Se2, AdjointMovesTwistsBetweenFrames) {
  for (std::uint64_t i = 0; i < kCases; ++i) {
    const SE2 T = SE2::exp(tangent(i));
    const Vector3d t = 0.3 * random_vector<3>(i + kCases, 1.0);
    EXPECT_TRUE(is_near(T * SE2::exp(t), SE2::exp(T.adjoint() * t) * T, 1e-13));
  }
}

TEST(Se2, EveryOperationKeepsTheAngleWrapped) {
  const SE2 T = SE2::from_xy_yaw(0, 0, 3.0);
  EXPECT_NEAR((T * T).angle, 6.0 - 2 * kPi, 1e-15);
  EXPECT_EQ(SE2::from_xy_yaw(0, 0, -kPi).angle, kPi);
  EXPECT_EQ(SE2::from_xy_yaw(0, 0, kPi).inverse().angle, kPi);
}

TEST(Se2, ProjectionKeepsPlaceAndHeadingOfATiltedPose) {
  const SE2 T = SE2::projected(SE3::from_xyz_rpy({1, 2, 3}, 0.2, -0.4, 2.5));
  EXPECT_TRUE(is_near(T, SE2::from_xy_yaw(1, 2, 2.5), 1e-15));
}

}  // namespace
}  // namespace trident
