// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "controlled_boat.h"
#include "trident_base/angle.h"

namespace trident {
namespace {

using Kind = VesselCommand::Kind;

/// Distance from the x axis after three minutes at 1.5 m/s through the water along it, in a current
/// of 0.5 m/s across: mean and largest of the last minute.
struct Held {
  double mean = 0.0, largest = 0.0, speed = 0.0;
};
Held hold_line(double integral_gain) {
  VesselControlParams control = shipped_control("otter");
  control.guidance.integral_gain = integral_gain;
  control.speed.reference = SpeedReference::kThroughWater;
  ControlledBoat boat("otter", control, uniform_current(0.5, 0.5 * kPi));
  boat.tell(follow({{0.0, 0.0}, {1000.0, 0.0}}));
  boat.run(180.0);
  Held held;
  constexpr int kSteps = 6000;
  for (int i = 0; i < kSteps; ++i) {
    boat.step();
    held.mean += boat.y() / kSteps;
    held.largest = std::max(held.largest, std::abs(boat.y()));
  }
  const Vector6d nu = boat.boat().nu();
  const Eigen::Vector3d flow = boat.boat().T_world_co().R.conjugate() * Eigen::Vector3d(0, 0.5, 0);
  held.speed = nu[0] - flow.x();
  return held;
}

TEST(LineOfSightGuidance, HoldsALineAgainstACurrentAcrossIt) {
  const Held held = hold_line(1.0);
  EXPECT_LT(held.largest, 0.5);
  EXPECT_NEAR(held.speed, 1.5, 0.02);
}

/// There the bow points up against the current by asin(0.5 / 1.5), as far as 10 m ahead allow.
TEST(LineOfSightGuidance, WithoutIntegralTheCurrentSetsItAside) {
  const Held held = hold_line(0.0);
  EXPECT_NEAR(held.mean, 10.0 * std::tan(std::asin(0.5 / 1.5)), 0.1);
  EXPECT_NEAR(held.speed, 1.5, 0.02);
}

TEST(LineOfSightGuidance, FinishesACourseOfWaypointsAndStaysThere) {
  ControlledBoat boat("otter", shipped_control("otter"), uniform_current(0.3, 1.0));
  const std::vector<Eigen::Vector2d> course = {{0, 0}, {60, 0}, {60, 40}, {0, 40}, {0, 10}};
  boat.tell(follow(course));
  std::vector<double> nearest(course.size(), 1e9);
  while (boat.controller().mode() != VesselMode::kStation && boat.time_s() < 300.0) {
    boat.step();
    for (std::size_t i = 0; i < course.size(); ++i) {
      nearest[i] = std::min(nearest[i], (course[i] - Eigen::Vector2d(boat.x(), boat.y())).norm());
    }
  }
  EXPECT_LT(boat.time_s(), 250.0);
  for (const double distance : nearest) EXPECT_LE(distance, 5.01);
  boat.run(200.0);
  EXPECT_LT((Eigen::Vector2d(boat.x(), boat.y()) - course.back()).norm(), 2.0);
}

TEST(CourseController, HoldsACourseOverGroundInACurrent) {
  ControlledBoat boat("otter", shipped_control("otter"), uniform_current(0.5, 0.5 * kPi));
  boat.tell(towards(Kind::kCourse, 0.3));
  boat.run(60.0);
  const double x = boat.x(), y = boat.y();
  boat.run(60.0);
  EXPECT_NEAR(std::atan2(boat.y() - y, boat.x() - x), 0.3, deg_to_rad(1.0));
  EXPECT_GT(std::abs(angle_difference(boat.heading(), 0.3)), deg_to_rad(10.0));
}

class EveryControlledBoat : public testing::TestWithParam<const char*> {
 protected:
  static VesselControlParams control() {
    const std::string vessel = GetParam();
    return shipped_control(vessel.rfind("wamv", 0) == 0 ? "wamv" : vessel);
  }
};

TEST_P(EveryControlledBoat, TurnsToAHeadingWithoutOvershoot) {
  ControlledBoat boat(GetParam(), control());
  boat.tell(towards(Kind::kHeading, 2.0));
  double highest = 0.0;
  for (int i = 0; i < 6000; ++i) {
    boat.step();
    highest = std::max(highest, boat.heading());
  }
  EXPECT_NEAR(boat.heading(), 2.0, deg_to_rad(0.5));
  EXPECT_LT(highest, 2.0 + deg_to_rad(3.0));
  EXPECT_NEAR(boat.boat().nu()[0], control().speed.cruise, 0.02);
}

TEST_P(EveryControlledBoat, FollowsVelocityCommandsAndStopsWithoutNewOnes) {
  ControlledBoat boat(GetParam(), control());
  for (int i = 0; i < 400; ++i) {
    boat.tell(velocity(0.8, 0.15));
    boat.run(0.1);
  }
  EXPECT_NEAR(boat.boat().nu()[0], 0.8, 0.05);
  EXPECT_NEAR(boat.boat().nu()[5], 0.15, 0.01);
  boat.run(60.0);
  EXPECT_NEAR(boat.boat().nu()[0], 0.0, 0.02);
  EXPECT_NEAR(boat.boat().nu()[5], 0.0, 0.01);
}

TEST_P(EveryControlledBoat, ComesToAStationFromAfar) {
  ControlledBoat boat(GetParam(), control(), uniform_current(0.15, 1.0));
  boat.tell(keep(-30.0, 20.0, 0.5));
  boat.run(300.0);
  double farthest = 0.0;
  for (int i = 0; i < 6000; ++i) {
    boat.step();
    farthest = std::max(farthest, std::hypot(boat.x() + 30.0, boat.y() - 20.0));
  }
  EXPECT_LT(farthest, 1.0);
}

INSTANTIATE_TEST_SUITE_P(All, EveryControlledBoat,
                         testing::Values("otter", "wamv", "wamv_t", "wamv_x", "heron",
                                         "small_catamaran"));

/// Hs 0.3 m, Tp 4 s, wind of 4 m/s: 95 % of 300 s within 1 m.
TEST(StationKeeping, HoldsAWamvWithXThrustersInWavesAndWind) {
  EnvironmentParams sea = uniform_current(0.0, 0.0);
  sea.waves.spectrum = WaveSpectrum::kJonswap;
  sea.waves.significant_height = 0.3;
  sea.waves.peak_period = 4.0;
  sea.waves.components = 60;
  ControlledBoat boat("wamv_x", shipped_control("wamv"), sea);
  boat.set_wind({-2.5, 3.12, 0.0});
  boat.place(5.0, -3.0, 0.3);
  boat.tell(keep(0.0, 0.0, 1.0));
  boat.run(60.0);
  int within = 0;
  double worst_heading = 0.0;
  for (int i = 0; i < 30000; ++i) {
    boat.step();
    within += std::hypot(boat.x(), boat.y()) < 1.0 ? 1 : 0;
    worst_heading = std::max(worst_heading, std::abs(boat.heading() - 1.0));
  }
  EXPECT_GE(within, 28500);
  EXPECT_LT(worst_heading, deg_to_rad(10.0));
}

}  // namespace
}  // namespace trident
