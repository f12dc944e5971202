// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/so3.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "is_near.h"
#include "trident_base/angle.h"

namespace trident {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

// Rotation vectors in many directions, at the lengths where formulas change or lose digits.
std::vector<Vector3d> rotation_vectors() {
  std::vector<Vector3d> result{Vector3d::Zero()};
  std::uint64_t i = 0;
  for (const double angle : {1e-200, 1e-12, 1e-8, 1e-4, 0.05, 0.29999, 0.3, 0.30001, 1.0, 2.0, 3.0,
                             kPi - 1e-4, kPi - 1e-9}) {
    for (int k = 0; k < 8; ++k) result.push_back(angle * random_vector<3>(i++, 1.0).normalized());
  }
  return result;
}

TEST(So3, SkewIsTheCrossProduct) {
  const Vector3d a(1.0, -2.0, 3.0);
  const Vector3d b(-4.0, 0.5, 2.0);
  EXPECT_EQ(skew(a) * b, a.cross(b));
}

TEST(So3, ExpAgreesWithAngleAxis) {
  for (const Vector3d& r : rotation_vectors()) {
    if (r.norm() < 1e-100) continue;
    const Quaterniond expected(Eigen::AngleAxisd(r.norm(), r.normalized()));
    EXPECT_TRUE(is_near(so3_exp(r).coeffs(), expected.coeffs(), 1e-15));
  }
  EXPECT_EQ(so3_exp(Vector3d::Zero()).coeffs(), Quaterniond::Identity().coeffs());
}

TEST(So3, LogInvertsExp) {
  for (const Vector3d& r : rotation_vectors()) {
    EXPECT_TRUE(is_near(so3_log(so3_exp(r)), r, 4e-15 * std::max(1e-12, r.norm())));
  }
}

TEST(So3, LogIsTheShorterRotationForBothSignsOfTheQuaternion) {
  const Quaterniond q = so3_exp(Vector3d(0.0, 0.0, 1.5 * kPi));
  const Quaterniond minus_q(-q.w(), -q.x(), -q.y(), -q.z());
  EXPECT_TRUE(is_near(so3_log(q), Vector3d(0.0, 0.0, -0.5 * kPi), 1e-14));
  EXPECT_TRUE(is_near(so3_log(minus_q), Vector3d(0.0, 0.0, -0.5 * kPi), 1e-14));
}

TEST(So3, LogOfAHalfTurnHasLengthPi) {
  EXPECT_TRUE(
      is_near(so3_log(Quaterniond(0.0, 0.6, 0.0, -0.8)), kPi * Vector3d(0.6, 0.0, -0.8), 1e-14));
}

TEST(So3, LeftJacobianAgreesWithCentralDifferences) {
  constexpr double kStep = 1e-6;
  for (const Vector3d& r : rotation_vectors()) {
    Matrix3d numeric;
    for (int k = 0; k < 3; ++k) {
      const Vector3d dr = kStep * Vector3d::Unit(k);
      const auto inverse = so3_exp(r).conjugate();
      numeric.col(k) =
          (so3_log(so3_exp(r + dr) * inverse) - so3_log(so3_exp(r - dr) * inverse)) / (2 * kStep);
    }
    EXPECT_TRUE(is_near(so3_left_jacobian(r), numeric, 1e-9));
  }
}

TEST(So3, LeftJacobianInverseInverts) {
  for (const Vector3d& r : rotation_vectors()) {
    EXPECT_TRUE(
        is_near(so3_left_jacobian(r) * so3_left_jacobian_inverse(r), Matrix3d::Identity(), 1e-14));
  }
}

}  // namespace
}  // namespace trident
