// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/core/cost_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace trident::nav {
namespace {

const GridGeometry kShifted{10, 20, 0.05, -1.0, 2.0};

TEST(GridGeometry, ACellContainsItsLowerCornerAndNotItsUpperOne) {
  const GridGeometry whole{10, 20, 1.0, -1.0, 2.0};
  for (const int i : {-3, -1, 0, 1, 7}) {
    EXPECT_EQ(whole.cell(-1.0 + i, 2.0 + i), (Cell{i, i}));
    EXPECT_EQ(whole.cell(-1.001 + i, 2.5 + i), (Cell{i - 1, i}));
  }
}

TEST(GridGeometry, PlacesFarOutsideAreFarOutsideOnTheirOwnSide) {
  for (const double far : {1e8, 1e12, 1e300, std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(kShifted.cell(far, -far),
              (Cell{GridGeometry::kFarthestCell, -GridGeometry::kFarthestCell}))
        << far;
    EXPECT_FALSE(kShifted.contains(kShifted.cell(far, 2.1)));
    EXPECT_FALSE(kShifted.contains(kShifted.cell(-1.0, -far)));
  }
}

TEST(GridGeometry, WhatIsNotANumberIsInNoCell) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(kShifted.contains(kShifted.cell(nan, 2.1)));
  EXPECT_FALSE(kShifted.contains(kShifted.cell(-0.9, nan)));
}

}  // namespace
}  // namespace trident::nav
