// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/core/footprint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "trident_base/error.h"

namespace trident::nav {
namespace {

std::string error_of(const std::string& text) {
  try {
    polygon_footprint(parse_polygon(text));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(FootprintTest, CirclesOfARectangle) {
  const Footprint footprint =
      polygon_footprint(parse_polygon(" [[-0.3,-0.2],[-0.3, 0.2], [ 0.4,0.2],[0.4,-.2]]"));
  EXPECT_DOUBLE_EQ(footprint.inscribed_radius, 0.2);
  EXPECT_DOUBLE_EQ(footprint.circumscribed_radius, std::hypot(0.4, 0.2));
  ASSERT_EQ(footprint.points.size(), 4U);
  EXPECT_EQ(footprint.points[0].y, -0.2);  // turned to be counter-clockwise
  EXPECT_EQ(footprint.points[0].x, 0.4);
}

TEST(FootprintTest, PaddingMovesEachCoordinateAwayFromTheAxes) {
  const Footprint padded = padded_footprint(
      polygon_footprint({{0.2, 0.0}, {0.0, 0.1}, {-0.2, -0.1}, {0.1, -0.1}}), 0.01);
  EXPECT_DOUBLE_EQ(padded.points[0].x, 0.21);
  EXPECT_DOUBLE_EQ(padded.points[0].y, 0.0);
  EXPECT_DOUBLE_EQ(padded.points[2].x, -0.21);
  EXPECT_DOUBLE_EQ(padded_footprint(circle_footprint(0.1), 0.02).inscribed_radius, 0.12);
}

TEST(FootprintTest, PolygonsThatCannotBeAreRefusedWithTheReason) {
  EXPECT_NE(error_of("[[0,0],[1,1]]").find("at least 3 corners, this one has 2"),
            std::string::npos);
  EXPECT_NE(error_of("[[1,1],[-1,-1],[1,-1],[-1,1]]").find("edges must not cross"),
            std::string::npos);
  EXPECT_NE(error_of("[[1,1],[2,1],[2,2]]").find("origin [0, 0] inside"), std::string::npos);
  EXPECT_NE(error_of("[[0,0],[1,0],[0,1]]").find("origin [0, 0] inside"), std::string::npos);
  EXPECT_NE(error_of("[[-1,0],[0,0],[1,0]]").find("no area"), std::string::npos);
  EXPECT_NE(error_of("[[1,2],[3").find("',' is expected, not its end"), std::string::npos);
  EXPECT_NE(error_of("[[1,a]]").find("a finite number is expected, not 'a]]'"), std::string::npos);
  EXPECT_NE(error_of("[[1,nan],[1,2],[0,1]]").find("finite number"), std::string::npos);
  EXPECT_NE(error_of("0.3").find("[[x, y], [x, y], ...]"), std::string::npos);
  EXPECT_THROW(circle_footprint(0.0), Error);
  EXPECT_THROW(padded_footprint(circle_footprint(0.1), -0.2), Error);
}

TEST(FootprintTest, ANotchNarrowerThanTwiceTheDistanceIsFilledByGrowth) {
  const Footprint forked = polygon_footprint({{-0.3, -0.2},
                                              {0.3, -0.2},
                                              {0.3, -0.01},
                                              {0.1, -0.01},
                                              {0.1, 0.01},
                                              {0.3, 0.01},
                                              {0.3, 0.2},
                                              {-0.3, 0.2}});
  const Footprint grown = grown_footprint(forked, 0.05);
  ASSERT_EQ(grown.points.size(), 4U);
  EXPECT_NEAR(grown.inscribed_radius, 0.25, 1e-12);
  EXPECT_NEAR(grown.circumscribed_radius, std::hypot(0.35, 0.25), 1e-12);
  EXPECT_EQ(grown_footprint(forked, 0.005).points.size(), 8U);
}

TEST(FootprintTest, CornersAreAtMostAKilometerAway) {
  EXPECT_NE(error_of("[[1,1],[-1001,0],[1,-1]]").find("up to +-1000 m"), std::string::npos);
  EXPECT_EQ(error_of("[[1,1],[-1000,0],[1,-1]]"), "");
}

TEST(FootprintTest, CornersAtAPose) {
  const Footprint footprint = polygon_footprint({{0.2, -0.1}, {0.2, 0.1}, {-0.2, 0.0}});
  const auto corners = footprint_corners(footprint, {1.0, 2.0, 1.5707963267948966});
  EXPECT_NEAR(corners[0].x, 1.1, 1e-12);
  EXPECT_NEAR(corners[0].y, 2.2, 1e-12);
  EXPECT_EQ(footprint_corners(circle_footprint(0.5), {}).size(), 16U);
}

}  // namespace
}  // namespace trident::nav
