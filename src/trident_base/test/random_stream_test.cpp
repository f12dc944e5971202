// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/random_stream.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "statistics.h"
#include "trident_base/noise.h"

namespace trident {
namespace {

using Words = std::array<std::uint32_t, 4>;

constexpr std::size_t kDraws = 100'000;
// Four standard errors of a correlation of independent samples.
const double kUncorrelated = 4.0 / std::sqrt(static_cast<double>(kDraws));

std::vector<double> normals(const RandomStream& stream, std::uint32_t channel,
                            std::uint64_t first = 0) {
  return draw_samples(kDraws, [&](std::size_t i) { return stream.normal(first + i, channel); });
}

// The vectors that Random123 publishes for philox4x32-10.
TEST(Philox, KnownAnswers) {
  EXPECT_EQ(philox4x32_10({0, 0, 0, 0}, {0, 0}),
            (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  constexpr std::uint32_t kOnes = 0xffffffff;
  EXPECT_EQ(philox4x32_10({kOnes, kOnes, kOnes, kOnes}, {kOnes, kOnes}),
            (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(
      philox4x32_10({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
      (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

// Recorded runs depend on these numbers; they were computed by a second, independent
// implementation.
TEST(RandomStream, ValuesNeverChange) {
  const RandomStream unnamed(0, "");
  EXPECT_EQ(unnamed.uniform(0, 0), 0.5395095424240778);
  EXPECT_DOUBLE_EQ(unnamed.normal(0, 0), 0.9049343128399305);
  EXPECT_EQ(unnamed.bits(0, 0), 0xca07dce0d14c0322u);
  const RandomStream imu(42, "UAV1/firefly/imu");
  EXPECT_EQ(imu.uniform(5'000'000'000, 3), 0.1819347140894464);
  EXPECT_DOUBLE_EQ(imu.normal(5'000'000'000, 3), -0.29091719059713217);
  EXPECT_EQ(imu.bits(5'000'000'000, 3), 0x176bfc0abbc94945u);
}

TEST(RandomStream, IsAPureFunctionInAnyOrder) {
  const RandomStream first(1, "imu");
  const RandomStream second(1, std::string("i") + "mu");
  for (std::uint64_t i = 0; i < 100; ++i) {
    EXPECT_EQ(first.normal(99 - i, 2), second.normal(99 - i, 2));
    EXPECT_EQ(first.normal(i, 2), second.normal(i, 2));
  }
}

TEST(RandomStream, UniformIsUniformOnTheHalfOpenUnitInterval) {
  const RandomStream stream(3, "uniform");
  const auto samples = draw_samples(kDraws, [&](std::size_t i) { return stream.uniform(i, 0); });
  for (const double x : samples) {
    ASSERT_GE(x, 0.0);
    ASSERT_LT(x, 1.0);
  }
  EXPECT_LT(kolmogorov_smirnov(samples, [](double x) { return x; }), 1.95);
}

TEST(RandomStream, NormalIsStandardNormal) {
  const auto samples = normals(RandomStream(3, "normal"), 0);
  const Moments m = moments(samples);
  const double n = kDraws;
  EXPECT_NEAR(m.mean, 0.0, 4.0 / std::sqrt(n));
  EXPECT_NEAR(m.variance, 1.0, 4.0 * std::sqrt(2.0 / n));
  EXPECT_NEAR(m.skewness, 0.0, 4.0 * std::sqrt(6.0 / n));
  EXPECT_NEAR(m.kurtosis, 3.0, 4.0 * std::sqrt(24.0 / n));
  const auto cumulative = [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); };
  EXPECT_LT(kolmogorov_smirnov(samples, cumulative), 1.95);
}

TEST(RandomStream, FourNormalsAtATimeAreStandardNormalAndIndependent) {
  const RandomStream stream(3, "lidar");
  std::array<std::vector<double>, 4> of_place;
  std::vector<double> all;
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    const auto four = stream.normals4(i, 5);
    for (std::size_t k = 0; k < 4; ++k) of_place[k].push_back(four[k]);
    all.insert(all.end(), four.begin(), four.end());
  }
  const Moments m = moments(all);
  const double n = 4.0 * kDraws;
  EXPECT_NEAR(m.mean, 0.0, 4.0 / std::sqrt(n));
  EXPECT_NEAR(m.variance, 1.0, 4.0 * std::sqrt(2.0 / n));
  EXPECT_NEAR(m.skewness, 0.0, 4.0 * std::sqrt(6.0 / n));
  EXPECT_NEAR(m.kurtosis, 3.0, 4.0 * std::sqrt(24.0 / n));
  const auto cumulative = [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); };
  EXPECT_LT(kolmogorov_smirnov(all, cumulative), 1.95);
  for (std::size_t k = 1; k < 4; ++k) {
    EXPECT_LT(std::abs(correlation(of_place[0], of_place[k])), kUncorrelated) << k;
  }
  EXPECT_LT(std::abs(correlation(of_place[0], normals(stream, 5))), kUncorrelated);
}

TEST(NormalRow, IsAFunctionOfItsChannelInAnyOrder) {
  const RandomStream stream(3, "lidar");
  NormalRow forward(stream, 7), backward(stream, 7);
  std::vector<float> values;
  for (std::uint32_t channel = 0; channel < 50; ++channel) values.push_back(forward.at(channel));
  for (std::uint32_t channel = 50; channel-- > 0;) {
    EXPECT_EQ(backward.at(channel), values[channel]) << channel;
  }
  EXPECT_NE(values[0], values[1]);
}

TEST(RandomStream, NamesAreIndependent) {
  const auto reference = normals(RandomStream(3, "UAV1/imu"), 0);
  for (const char* name : {"UAV2/imu", "UAV1/imu2", "UAV1/im", "1UAV/imu", ""}) {
    EXPECT_LT(std::abs(correlation(reference, normals(RandomStream(3, name), 0))), kUncorrelated)
        << name;
  }
}

TEST(RandomStream, SeedsAreIndependent) {
  const auto reference = normals(RandomStream(3, "imu"), 0);
  for (const std::uint64_t seed : {0ULL, 2ULL, 4ULL, 3ULL + (1ULL << 32), 1ULL << 63}) {
    EXPECT_LT(std::abs(correlation(reference, normals(RandomStream(seed, "imu"), 0))),
              kUncorrelated)
        << seed;
  }
}

TEST(RandomStream, ChannelsIndicesAndDistributionsAreIndependent) {
  const RandomStream stream(3, "imu");
  const auto reference = normals(stream, 0);
  EXPECT_LT(std::abs(correlation(reference, normals(stream, 1))), kUncorrelated);
  EXPECT_LT(std::abs(correlation(reference, normals(stream, 0, 1))), kUncorrelated);
  EXPECT_LT(std::abs(correlation(reference, normals(stream, 0, 1ULL << 32))), kUncorrelated);
  const auto uniforms = draw_samples(kDraws, [&](std::size_t i) { return stream.uniform(i, 0); });
  EXPECT_LT(std::abs(correlation(reference, uniforms)), kUncorrelated);
}

}  // namespace
}  // namespace trident
