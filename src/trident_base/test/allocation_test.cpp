// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "allocation_count.h"
#include "trident_base/noise.h"
#include "trident_base/se2.h"
#include "trident_base/se3.h"
#include "trident_base/sha256.h"

namespace trident {
namespace {

TEST(Allocation, TheCounterCounts) {
  EXPECT_EQ(allocations_of([] { ::operator delete(::operator new(8)); }), 1u);
  void* volatile memory = nullptr;  // volatile: the compiler leaves out what nobody sees
  EXPECT_EQ(allocations_of([&] { memory = std::malloc(8); }), 1u);
  EXPECT_EQ(allocations_of([&] { memory = std::realloc(memory, 10'000); }), 1u);
  std::free(memory);
  EXPECT_EQ(allocations_of([&] { memory = std::calloc(2, 8); }), 1u);
  EXPECT_EQ(allocations_of([&] { std::free(memory); }), 0u);
}

TEST(Allocation, ImuNoiseDoesNotAllocatePerSample) {
  ImuNoise noise(ImuNoiseParams{}, 0.01, RandomStream(1, "UAV1/firefly/imu"));
  Eigen::Vector3d w = Eigen::Vector3d::Zero();
  Eigen::Vector3d f = Eigen::Vector3d::Zero();
  EXPECT_EQ(allocations_of([&] {
              for (std::uint64_t i = 0; i < 1000; ++i) noise.add(i, &w, &f);
            }),
            0u);
  EXPECT_NE(w, Eigen::Vector3d::Zero());
}

TEST(Allocation, VectorNoiseAndStreamsDoNotAllocate) {
  const GaussianNoise3 gaussian{{0, 0, 0}, {1, 1, 1}};
  const UniformNoise3 uniform{{-1, -1, -1}, {1, 1, 1}};
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  EXPECT_EQ(allocations_of([&] {
              const RandomStream stream(1, "a name that is too long for a small string buffer");
              for (std::uint64_t i = 0; i < 100; ++i) {
                sum += gaussian.sample(stream, i, 0) + uniform.sample(stream, i, 3);
              }
            }),
            0u);
  EXPECT_NE(sum, Eigen::Vector3d::Zero());
}

TEST(Allocation, TransformsDoNotAllocate) {
  SE3 T = SE3::from_xyz_rpy({1, 2, 3}, 0.1, 0.2, 0.3);
  SE2 U = SE2::from_xy_yaw(1, 2, 0.3);
  EXPECT_EQ(allocations_of([&] {
              T = SE3::exp(0.5 * T.adjoint() * (T * T.inverse() * T).log());
              U = SE2::exp(0.5 * U.adjoint() * (U * U.inverse() * U).log());
            }),
            0u);
  EXPECT_NE(T.p, Eigen::Vector3d(1, 2, 3));
  EXPECT_NE(U.p, Eigen::Vector2d(1, 2));
}

TEST(Allocation, FeedingAHashDoesNotAllocate) {
  Sha256 hash;
  EXPECT_EQ(allocations_of([&] {
              for (int i = 0; i < 1000; ++i) hash.update_double(i);
            }),
            0u);
}

}  // namespace
}  // namespace trident
