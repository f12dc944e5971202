// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/vehicle/wheel_encoder.h"

#include <gtest/gtest.h>

namespace trident {
namespace {

TEST(WheelEncoder, CountsWholeMarksInBothDirections) {
  const WheelEncoder encoder(4);
  EXPECT_EQ(encoder.ticks(0.0), 0);
  EXPECT_EQ(encoder.ticks(0.49 * kPi), 0);
  EXPECT_EQ(encoder.ticks(0.51 * kPi), 1);
  EXPECT_EQ(encoder.ticks(20.01 * kPi), 40) << "turns count on";
  EXPECT_EQ(encoder.ticks(-0.01 * kPi), -1);
  EXPECT_EQ(encoder.ticks(-0.51 * kPi), -2);
}

TEST(WheelEncoder, AMeasuredAngleIsTooLowByLessThanATick) {
  const WheelEncoder encoder(1024);
  for (int i = -2000; i < 2000; ++i) {
    const double angle = 0.0137 * i, measured = encoder.angle(encoder.ticks(angle));
    EXPECT_LE(measured, angle + 1e-12);
    EXPECT_GT(measured, angle - 2.0 * kPi / 1024.0 - 1e-12);
  }
}

TEST(WheelEncoder, NeedsATick) {
  EXPECT_THROW(WheelEncoder(0), Error);
  EXPECT_THROW(WheelEncoder(-3), Error);
}

}  // namespace
}  // namespace trident
