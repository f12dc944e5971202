// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/source_age.h"

#include <gtest/gtest.h>

#include <cmath>

namespace trident::nav {
namespace {

SourceAge after(SourceAge age, double period_s, int count) {
  for (int i = 0; i < count; ++i) age.note(10.0 + i * period_s);
  return age;
}

TEST(SourceAgeTest, TheLimitIsThreePeriodsAndAtLeastThreeTenthsOfASecond) {
  const SourceAge slow = after(SourceAge(), 0.2, 10);
  EXPECT_NEAR(slow.period_s(), 0.2, 1e-9);
  EXPECT_NEAR(slow.limit_s(), 0.6, 1e-9);
  EXPECT_FALSE(slow.is_stale(11.8 + 0.59));
  EXPECT_TRUE(slow.is_stale(11.8 + 0.61));
  EXPECT_DOUBLE_EQ(after(SourceAge(), 0.025, 10).limit_s(), 0.3);
}

TEST(SourceAgeTest, ALostMessageOrABurstChangesNoLimit) {
  SourceAge age = after(SourceAge(), 0.2, 10);
  age.note(12.4);
  age.note(12.401);
  EXPECT_NEAR(age.limit_s(), 0.6, 1e-9);
}

TEST(SourceAgeTest, WhatTheUserSaysComesFirst) {
  EXPECT_EQ(after(SourceAge({0.5, -1.0}), 0.05, 10).limit_s(), 0.5);
  EXPECT_EQ(after(SourceAge({0.5, 2.0}), 0.05, 10).limit_s(), 2.0);
  // As in costmap_2d, nothing is ever stale without expected_update_rate.
  const SourceAge upstream = after(SourceAge({0.0, 0.0}), 0.05, 10);
  EXPECT_TRUE(std::isinf(upstream.limit_s()));
  EXPECT_FALSE(upstream.is_stale(1e9));
  EXPECT_FALSE(SourceAge({0.0, 0.0}).is_stale(1e9));
  EXPECT_EQ(after(SourceAge({0.5, 0.0}), 0.05, 10).limit_s(), 0.5);
}

TEST(SourceAgeTest, NothingYetIsStaleAndOneMessageHasASecond) {
  SourceAge age;
  EXPECT_TRUE(age.is_stale(0.0));
  EXPECT_TRUE(std::isinf(age.age_s(0.0)));
  age.note(5.0);
  EXPECT_FALSE(age.is_stale(5.9));
  EXPECT_TRUE(age.is_stale(6.1));
}

TEST(SourceAgeTest, AfterTimeWasSetBackThePeriodIsMeasuredAgain) {
  SourceAge age = after(SourceAge(), 0.2, 10);
  EXPECT_TRUE(age.is_stale(0.0));  // the newest data lie far in the future
  age.note(0.0);
  EXPECT_FALSE(age.is_stale(0.1));
  EXPECT_EQ(age.period_s(), 0.0);
  age.note(0.1);
  EXPECT_NEAR(age.period_s(), 0.1, 1e-9);
}

}  // namespace
}  // namespace trident::nav
