// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <vector>

#include "trident_sim/sample_clock.h"

namespace trident::sim {
namespace {

/// Steps, counted from 1, in which a sensor of `rate_hz` measures.
std::vector<std::uint64_t> due_steps(double rate_hz, std::int64_t dt_ns, std::uint64_t steps) {
  const SampleClock clock(rate_hz);
  std::vector<std::uint64_t> result;
  StepInfo info;
  info.dt = {dt_ns};
  info.dt_s = info.dt.seconds();
  for (info.sample = 1; info.sample <= steps; ++info.sample) {
    if (clock.is_due(info)) result.push_back(info.sample);
  }
  return result;
}

TEST(SampleClock, APeriodOfWholeStepsIsOnTime) {
  EXPECT_EQ(due_steps(10.0, 1'000'000, 350), (std::vector<std::uint64_t>{100, 200, 300}));
  EXPECT_EQ(due_steps(50.0, 10'000'000, 7), (std::vector<std::uint64_t>{2, 4, 6}));
}

TEST(SampleClock, APeriodThatIsNoneDoesNotDrift) {
  const auto steps = due_steps(30.0, 1'000'000, 10'000);
  ASSERT_EQ(steps.size(), 300u);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const double due_s = static_cast<double>(k + 1) / 30.0;
    const double taken_s = static_cast<double>(steps[k]) * 1e-3;
    EXPECT_GE(taken_s, due_s - 1e-9);
    EXPECT_LT(taken_s, due_s + 1e-3);
  }
}

TEST(SampleClock, ZeroAndWhatIsFasterThanTheStepMeanEveryStep) {
  EXPECT_EQ(due_steps(0.0, 10'000'000, 3).size(), 3u);
  EXPECT_EQ(due_steps(1000.0, 10'000'000, 3).size(), 3u);
}

TEST(SampleClock, LongRunsKeepTheirCount) {
  const SampleClock clock(40.0);
  StepInfo info;
  info.dt = {1'000'000};
  info.dt_s = 1e-3;
  info.sample = 1'000'000'000;  // eleven days
  EXPECT_EQ(clock.count_at(info), 40'000'000u);
}

}  // namespace
}  // namespace trident::sim
