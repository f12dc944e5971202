// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/angle.h"

#include <gtest/gtest.h>

namespace trident {
namespace {

TEST(Angle, ABearingIsInOneTurn) {
  EXPECT_EQ(wrap_to_360(0.0), 0.0);
  EXPECT_EQ(wrap_to_360(360.0), 0.0);
  EXPECT_EQ(wrap_to_360(-90.0), 270.0);
  EXPECT_EQ(wrap_to_360(725.0), 5.0);
  EXPECT_EQ(wrap_to_360(-1e-20), 0.0);  // 360 - 1e-20 is 360 as a double
}

}  // namespace
}  // namespace trident
