// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/curves/footprint_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "planning/reference_search.h"
#include "trident_base/random_stream.h"

namespace trident::nav {
namespace {

using testing::TestGrid;

Footprint box(double length, double width) {
  Footprint footprint;
  footprint.points = {{-length / 2, -width / 2},
                      {length / 2, -width / 2},
                      {length / 2, width / 2},
                      {-length / 2, width / 2}};
  return completed(footprint);
}

FootprintContact checker(const TestGrid& grid, const Footprint& footprint) {
  return {grid.view(), footprint, FootprintContact::Unknown::kFree};
}

TEST(FootprintContact, AFootprintAsWideAsTheGapPassesIt) {
  TestGrid grid(60, 60, kFreeCost, 0.05);
  for (int y = 0; y < 60; ++y) {
    if (y < 26 || y >= 34) grid(30, y) = kLethalCost;
  }
  const auto contact = checker(grid, box(0.6, 0.4));
  EXPECT_FALSE(contact.in_contact({1.5, 1.5, 0.0}));
  EXPECT_TRUE(contact.in_contact({1.5, 1.51, 0.0}));
  EXPECT_TRUE(contact.in_contact({1.5, 1.5, 0.02}));
}

TEST(FootprintContact, AnObstacleInsideCounts) {
  TestGrid grid(60, 60, kFreeCost, 0.05);
  grid(30, 30) = kLethalCost;
  EXPECT_TRUE(checker(grid, box(1.0, 1.0)).in_contact({1.5, 1.5, 0.4}));
}

TEST(FootprintContact, TheBorderOfTheGridIsAnObstacle) {
  TestGrid grid(60, 60, kFreeCost, 0.05);
  grid.measure_distances(2.0F);
  const auto contact = checker(grid, box(0.4, 0.4));
  EXPECT_FALSE(contact.in_contact({0.2, 1.5, 0.0}));
  EXPECT_TRUE(contact.in_contact({0.19, 1.5, 0.0}));
}

TEST(FootprintContact, IgnoredCellsAreFree) {
  TestGrid grid(60, 60, kFreeCost, 0.05);
  grid(30, 30) = kLethalCost;
  grid(36, 30) = kLethalCost;
  auto contact = checker(grid, box(0.4, 0.4));
  contact.ignore_under({1.5, 1.5, 0.0});
  EXPECT_FALSE(contact.in_contact({1.52, 1.5, 0.0}));
  EXPECT_TRUE(contact.in_contact({1.65, 1.5, 0.0}));
}

TEST(FootprintContact, WhatIsALittleInAWallMayLeaveIt) {
  TestGrid grid(60, 60, kFreeCost, 0.05);
  for (int x = 0; x < 60; ++x) grid(x, 20) = kLethalCost;  // from y = 1.0 to 1.05
  auto contact = checker(grid, box(0.4, 0.4));
  const Pose2 start{1.5, 1.23, 0.0};
  ASSERT_TRUE(contact.in_contact(start));
  EXPECT_FALSE(contact.let_leave({1.5, 1.1, 0.0}, 0.03)) << "the wall is under the robot";
  EXPECT_TRUE(contact.in_contact(start)) << "a refusal changes nothing";
  EXPECT_TRUE(contact.let_leave(start, 0.03));
  EXPECT_FALSE(contact.in_contact(start));
  EXPECT_TRUE(contact.in_contact({1.5, 1.15, 0.0})) << "deeper into the wall";
  EXPECT_TRUE(contact.in_contact({2.1, 1.23, 0.0})) << "farther away the whole footprint counts";
}

/// Whether the square of a cell and a convex polygon overlap: by the axes of both (separating axis
/// theorem).
bool overlaps(const std::vector<Point2>& polygon, double x, double y, double side) {
  const std::vector<Point2> square{{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
  std::vector<Point2> normals{{1.0, 0.0}, {0.0, 1.0}};
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point2& a = polygon[i];
    const Point2& b = polygon[(i + 1) % polygon.size()];
    normals.push_back({a.y - b.y, b.x - a.x});
  }
  for (const Point2& n : normals) {
    double low[2] = {1e9, 1e9};
    double high[2] = {-1e9, -1e9};
    for (int k = 0; k < 2; ++k) {
      for (const Point2& p : k == 0 ? polygon : square) {
        low[k] = std::min(low[k], n.x * p.x + n.y * p.y);
        high[k] = std::max(high[k], n.x * p.x + n.y * p.y);
      }
    }
    if (high[0] <= low[1] + 1e-12 || high[1] <= low[0] + 1e-12) return false;
  }
  return true;
}

TEST(FootprintContact, EqualsTheSeparatingAxisTest) {
  const RandomStream random(3, "footprint");
  std::uint64_t n = 0;
  TestGrid grid(60, 60, kFreeCost, 0.05);
  for (int i = 0; i < 60; ++i) {
    const int x = static_cast<int>(random.uniform(n++, 0) * 60);
    grid(x, static_cast<int>(random.uniform(n++, 0) * 60)) = kLethalCost;
  }
  grid.measure_distances(1.0F);
  const Footprint footprint = box(0.5, 0.3);
  const auto contact = checker(grid, footprint);
  for (int i = 0; i < 3000; ++i) {
    const Pose2 pose{0.5 + 2.0 * random.uniform(n++, 0), 0.5 + 2.0 * random.uniform(n++, 0),
                     7.0 * random.uniform(n++, 0)};
    std::vector<Point2> polygon;
    for (const Point2& p : footprint.points) polygon.push_back(transform(pose, p));
    bool expected = false;
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 60; ++x) {
        if (grid(x, y) == kLethalCost) expected |= overlaps(polygon, x * 0.05, y * 0.05, 0.05);
      }
    }
    ASSERT_EQ(contact.in_contact(pose), expected) << pose.x << " " << pose.y << " " << pose.yaw;
    if (contact.margin(pose) > 0.0) {
      ASSERT_FALSE(expected);
    }
  }
}

TEST(FootprintContact, RadiiAreThoseOfThePolygon) {
  const Footprint footprint = box(0.8, 0.6);
  EXPECT_DOUBLE_EQ(footprint.inscribed_radius, 0.3);
  EXPECT_DOUBLE_EQ(footprint.circumscribed_radius, 0.5);
}

}  // namespace
}  // namespace trident::nav
