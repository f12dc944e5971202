// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "walkers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "trident_base/error.h"

namespace trident::benchmarks {
namespace {

constexpr double kStep_s = 0.02;

double separation(const nav::Point2& a, const nav::Point2& b) {
  return nav::distance(a.x, a.y, b.x, b.y);
}

TEST(Walkers, BeginAwayFromTheRobotAndFromEachOther) {
  const WalkerParams params;
  const nav::Point2 robot{-5.0, 0.0};
  const Walkers walkers(params, 3, robot);
  ASSERT_EQ(walkers.all().size(), 10U);
  for (std::size_t i = 0; i < 10; ++i) {
    const Walker& one = walkers.all()[i];
    EXPECT_GE(separation(one.position, robot), params.start_distance);
    EXPECT_GE(one.speed_m_s, params.min_speed);
    EXPECT_LE(one.speed_m_s, params.max_speed);
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_GT(separation(one.position, walkers.all()[k].position), 2.0 * params.radius);
    }
  }
}

TEST(Walkers, WalkThroughTheWholeHallWithoutOverlapAndStayInIt) {
  const WalkerParams params;
  Walkers walkers(params, 5, {-5.0, 0.0});
  double nearest_m = 1e9, farthest_m = -1e9, fastest = 0.0;
  for (int step = 0; step < 3000; ++step) {
    walkers.step(kStep_s);
    for (std::size_t i = 0; i < 10; ++i) {
      const Walker& one = walkers.all()[i];
      farthest_m = std::max({farthest_m, std::fabs(one.position.x) - 0.5 * params.hall[0],
                             std::fabs(one.position.y) - 0.5 * params.hall[1]});
      fastest = std::max(fastest, std::hypot(one.velocity.x, one.velocity.y));
      for (std::size_t k = 0; k < i; ++k) {
        nearest_m = std::min(nearest_m, separation(one.position, walkers.all()[k].position));
      }
    }
  }
  EXPECT_LE(farthest_m, -params.radius + 1e-9);
  EXPECT_LE(fastest, params.max_speed + 1e-9);
  EXPECT_GT(nearest_m, params.radius);  // shoulders may brush
  for (const Walker& one : walkers.all()) EXPECT_GE(one.legs, 3U);
}

TEST(Walkers, AreThoseOfTheirSeed) {
  Walkers a({}, 7, {0.0, 0.0}), b({}, 7, {0.0, 0.0}), c({}, 8, {0.0, 0.0});
  for (int step = 0; step < 100; ++step) {
    for (Walkers* walkers : {&a, &b, &c}) walkers->step(kStep_s);
  }
  EXPECT_EQ(a.all()[4].position.x, b.all()[4].position.x);
  EXPECT_NE(a.all()[4].position.x, c.all()[4].position.x);
}

TEST(Walkers, AHallWithoutRoomAndSpeedsInTheWrongOrderAreRefused) {
  WalkerParams many;
  many.count = 900;
  EXPECT_THROW(Walkers(many, 1, {0.0, 0.0}), Error);
  WalkerParams swapped;
  swapped.min_speed = 2.0;
  EXPECT_THROW(Walkers(swapped, 1, {0.0, 0.0}), Error);
}

}  // namespace
}  // namespace trident::benchmarks
