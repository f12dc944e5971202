// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/se3.h"

#include <gtest/gtest.h>

#include <vector>

#include "is_near.h"
#include "trident_base/angle.h"

namespace trident {
namespace {

using Eigen::Vector3d;

constexpr std::uint64_t kPoses = 100;

// Rotational parts of every length below pi.
Vector6d test_twist(std::uint64_t i) {
  Vector6d t = random_vector<6>(i, 1.0);
  t.head<3>() *= 20.0;
  t.tail<3>() = t.tail<3>().normalized() * kPi * (static_cast<double>(i) / kPoses);
  return t;
}

TEST(Se3, ComposedWithItsInverseIsIdentity) {
  for (std::uint64_t i = 0; i < kPoses; ++i) {
    const SE3 T = SE3::exp(test_twist(i));
    EXPECT_TRUE(is_near(T * T.inverse(), SE3::identity(), 1e-13));
    EXPECT_TRUE(is_near(T.inverse() * T, SE3::identity(), 1e-13));
  }
}

TEST(Se3, CompositionIsAssociativeAndActsOnPoints) {
  for (std::uint64_t i = 0; i + 2 < kPoses; ++i) {
    const SE3 a = SE3::exp(test_twist(i));
    const SE3 b = SE3::exp(test_twist(i + 1));
    const SE3 c = SE3::exp(test_twist(i + 2));
    const Vector3d point = random_vector<3>(i, 5.0);
    EXPECT_TRUE(is_near((a * b) * c, a * (b * c), 1e-12));
    EXPECT_TRUE(is_near((a * b) * point, a * (b * point), 1e-12));
    EXPECT_TRUE(is_near((a * b).matrix(), a.matrix() * b.matrix(), 1e-12));
  }
}

TEST(Se3, LogInvertsExp) {
  for (std::uint64_t i = 0; i < kPoses; ++i) {
    EXPECT_TRUE(is_near(SE3::exp(test_twist(i)).log(), test_twist(i), 1e-12));
  }
}

TEST(Se3, ExpOfATwistIsTheMotionOfManySmallSteps) {
  const Vector6d twist = test_twist(60);
  SE3 stepped = SE3::identity();
  constexpr int kSteps = 1024;
  for (int i = 0; i < kSteps; ++i) stepped = stepped * SE3::exp(twist / kSteps);
  EXPECT_TRUE(is_near(stepped, SE3::exp(twist), 1e-11));
}

TEST(Se3, ExpOfAQuarterTurnMovesAlongTheArc) {
  Vector6d twist;
  twist << kPi / 2, 0, 0, 0, 0, kPi / 2;  // radius 1
  EXPECT_TRUE(is_near(SE3::exp(twist), SE3::from_xyz_rpy({1, 1, 0}, 0, 0, kPi / 2), 1e-15));
}

TEST(Se3, AdjointMovesTwistsBetweenFrames) {
  for (std::uint64_t i = 0; i + 1 < kPoses; ++i) {
    const SE3 T = SE3::exp(test_twist(i));
    const Vector6d t = 0.3 * random_vector<6>(i, 1.0);
    EXPECT_TRUE(is_near(T * SE3::exp(t), SE3::exp(T.adjoint() * t) * T, 1e-12));
    const SE3 U = SE3::exp(test_twist(i + 1));
    EXPECT_TRUE(is_near((T * U).adjoint(), T.adjoint() * U.adjoint(), 1e-11));
  }
}

TEST(Se3, RollPitchYawTurnAboutFixedAxes) {
  // First roll takes y to z, then yaw leaves z where it is.
  const SE3 T = SE3::from_xyz_rpy({1, 2, 3}, kPi / 2, 0, kPi / 2);
  EXPECT_TRUE(is_near(T * Vector3d::UnitY(), Vector3d(1, 2, 4), 1e-15));
  EXPECT_TRUE(is_near(T * Vector3d::UnitX(), Vector3d(1, 3, 3), 1e-15));
}

TEST(Se3, RpyInvertsFromXyzRpy) {
  for (std::uint64_t i = 0; i < kPoses; ++i) {
    const Vector3d rpy = random_vector<3>(i, 1.0).cwiseProduct(Vector3d(kPi, kPi / 2, kPi));
    EXPECT_TRUE(is_near(SE3::from_xyz_rpy({0, 0, 0}, rpy[0], rpy[1], rpy[2]).rpy(), rpy, 1e-13));
  }
}

TEST(Se3, RpyReproducesTheRotationAtAndNearGimbalLock) {
  for (const double off : {0.0, 1e-15, 1e-13, 1e-11, 1e-9, 1e-7, 1e-4}) {
    for (const double sign : {-1.0, 1.0}) {
      const SE3 T = SE3::from_xyz_rpy(Vector3d::Zero(), 0.7, sign * (kPi / 2 - off), -0.4);
      const Vector3d rpy = T.rpy();
      EXPECT_TRUE(is_near(SE3::from_xyz_rpy({0, 0, 0}, rpy[0], rpy[1], rpy[2]), T, 1e-12)) << off;
    }
  }
}

}  // namespace
}  // namespace trident
