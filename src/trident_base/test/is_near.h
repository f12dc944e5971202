// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "trident_base/random_stream.h"
#include "trident_base/se2.h"
#include "trident_base/se3.h"

namespace trident {

template <class A, class B>
testing::AssertionResult is_near(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b,
                                 double tolerance) {
  const double worst = (a - b).cwiseAbs().maxCoeff();
  if (worst <= tolerance) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "\n"
                                     << a << "\nand\n"
                                     << b << "\ndiffer by " << worst << " > " << tolerance;
}

inline testing::AssertionResult is_near(const SE3& a, const SE3& b, double tolerance) {
  return is_near(a.matrix(), b.matrix(), tolerance);
}

inline testing::AssertionResult is_near(const SE2& a, const SE2& b, double tolerance) {
  return is_near(a.to_se3().matrix(), b.to_se3().matrix(), tolerance);
}

/// The i-th of a fixed sequence of vectors with independent components, uniform in [-scale, scale).
template <int N>
Eigen::Matrix<double, N, 1> random_vector(std::uint64_t i, double scale) {
  const RandomStream stream(7, "test vectors");
  Eigen::Matrix<double, N, 1> v;
  for (int k = 0; k < N; ++k) {
    v[k] = scale * (2.0 * stream.uniform(i, static_cast<std::uint32_t>(k)) - 1.0);
  }
  return v;
}

}  // namespace trident
