// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "controlled_boat.h"
#include "scratch_folder.h"
#include "test_world.h"
#include "trident_base/angle.h"

namespace trident::sim {
namespace {

using Kind = control::VesselCommand::Kind;

/// Distance from the x axis after three minutes at 1.5 m/s through the water along it, in a current
/// of 0.5 m/s across: mean and largest of the last minute.
struct Held {
  double mean = 0.0, largest = 0.0, speed = 0.0;
};
Held hold_line(double integral_gain) {
  control::VesselControlParams control = shipped_control("otter");
  control.guidance.integral_gain = integral_gain;
  control.speed.reference = control::SpeedReference::kThroughWater;
  ControlledBoat boat("otter", control, uniform_current(0.5, 0.5 * kPi));
  boat.command(follow({{0.0, 0.0}, {1000.0, 0.0}}));
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
  boat.command(follow(course));
  std::vector<double> nearest(course.size(), 1e9);
  while (boat.controller().mode() != control::VesselMode::kStation && boat.time_s() < 300.0) {
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
  boat.command(towards(Kind::kCourse, 0.3));
  boat.run(60.0);
  const double x = boat.x(), y = boat.y();
  boat.run(60.0);
  EXPECT_NEAR(std::atan2(boat.y() - y, boat.x() - x), 0.3, deg_to_rad(1.0));
  EXPECT_GT(std::abs(angle_difference(boat.heading(), 0.3)), deg_to_rad(10.0));
}

TEST(SpeedController, IsThroughTheWaterWithALogAndOverGroundWithout) {
  control::VesselControlParams control = shipped_control("otter");
  ControlledBoat over_ground("otter", control, uniform_current(0.4, 0.0));
  control.speed.reference = control::SpeedReference::kThroughWater;
  ControlledBoat logged("otter", control, uniform_current(0.4, 0.0));
  for (ControlledBoat* boat : {&over_ground, &logged}) {
    boat->command(towards(Kind::kHeading, 0.0));
    for (int i = 0; i < 6000; ++i) {
      const SimTime now{10'000'000 * static_cast<std::int64_t>(i + 1)};
      boat->controller().set_log(now, boat->boat().nu()[0] - 0.4);
      boat->step();
    }
  }
  EXPECT_NEAR(over_ground.boat().nu()[0], control.speed.cruise, 0.01);
  EXPECT_NEAR(logged.boat().nu()[0], control.speed.cruise + 0.4, 0.01);
}

std::string refusal(const std::string& yaml) {
  return error_of([&] { load_yaml_string<control::VesselControlParams>(yaml, "control.yaml"); });
}

TEST(VesselControlFile, IsReadStrictly) {
  EXPECT_TRUE(
      contains(refusal("heading:\n  max_rat: 1"), "control.yaml:2: heading.max_rat: unknown key"));
  EXPECT_TRUE(contains(refusal("speed: {max: fast}"), "speed.max"));
  EXPECT_TRUE(contains(refusal("guidance: {lookahead: -1}"), "> 0"));
  EXPECT_TRUE(contains(refusal("station: {behaviour: drift}"), "automatic, pose, weather_vane"));
  EXPECT_TRUE(contains(refusal("speed: {cruise: 3.0}"), "cruise = 3 m/s, legal is at most max"));
}

TEST(VesselControlFile, APoseWantsThrustersThatPushSideways) {
  control::VesselControlParams control = shipped_control("otter");
  control.station.behavior = control::StationBehavior::kPose;
  EXPECT_TRUE(
      contains(error_of([&] { control::VesselController(shipped_model("otter"), control); }),
               "station.behaviour = pose"));
}

TEST(VesselModelFile, WithoutThrustersOrWithACurveThatFallsIsRefused) {
  const ScratchFolder folder;
  const std::string body = "name: v\nmass: 1\ninertia: [1, 1, 1]\nhull: {any: thing}\n";
  const std::string none = folder.write("none.yaml", body);
  EXPECT_TRUE(
      contains(error_of([&] { control::load_vessel_model(none); }), "legal, to be controlled"));
  const std::string falling = folder.write(
      "falling.yaml", body +
                          "thrusters:\n  - {name: a, position: [0, 0, 0], mapping: "
                          "table, table_commands: [-1, 0, 1], table_forces: [-1, 2, 1]}\n");
  EXPECT_TRUE(contains(error_of([&] { control::load_vessel_model(falling); }),
                       "thruster 'a': table_forces[2]"));
}

TEST(VesselController, CommandsOfALaterStampWaitAndAResetForgetsThem) {
  ControlledBoat boat("otter", shipped_control("otter"));
  boat.controller().push(SimTime::from_seconds(5.0), follow({{50.0, 0.0}}));
  boat.run(4.9);
  EXPECT_EQ(boat.controller().mode(), control::VesselMode::kIdle);
  boat.run(0.2);
  EXPECT_EQ(boat.controller().mode(), control::VesselMode::kPath);
  boat.controller().push(SimTime::from_seconds(50.0), keep(0.0, 0.0, 0.0));
  EXPECT_EQ(boat.controller().update({0}, {}), control::ControlStatus::ok);
  EXPECT_EQ(boat.controller().mode(), control::VesselMode::kIdle);
  EXPECT_EQ(boat.controller().update(SimTime::from_seconds(55.0), {}), control::ControlStatus::ok);
  EXPECT_EQ(boat.controller().mode(), control::VesselMode::kIdle);
  control::OdometryState broken;
  broken.v_body.x() = std::nan("");
  EXPECT_EQ(boat.controller().update(SimTime::from_seconds(56.0), broken),
            control::ControlStatus::invalid_state);
}

TEST(VesselController, ThrustersStandAfterAStopUntilTheNextCommand) {
  ControlledBoat boat("otter", shipped_control("otter"));
  control::VesselCommand stop;
  stop.kind = Kind::kStop;
  const auto is_at_rest = [&] {
    const auto commands = boat.controller().commands();
    return std::all_of(commands.begin(), commands.end(), [](double one) { return one == 0.0; });
  };
  boat.command(velocity(1.0, 0.1));
  boat.run(5.0);
  EXPECT_FALSE(is_at_rest());
  boat.command(stop);
  boat.run(1.0);
  EXPECT_TRUE(is_at_rest());
  EXPECT_EQ(boat.controller().mode(), control::VesselMode::kIdle);
  boat.command(velocity(1.0, 0.1));
  boat.run(1.0);
  EXPECT_FALSE(is_at_rest());
}

TEST(VesselController, AStampedPathThatComesAgainIsNotStartedAgain) {
  const auto place = [](double repeated_at, double stamp) {
    ControlledBoat boat("otter", shipped_control("otter"), uniform_current(0.3, 1.0));
    const control::VesselCommand path = follow({{5.0, 20.0}, {80.0, 20.0}});
    boat.controller().push(SimTime::from_seconds(1.0), path);
    boat.run(repeated_at);
    EXPECT_EQ(boat.controller().push(SimTime::from_seconds(stamp), path).refused, "");
    boat.run(30.0 - repeated_at);
    return Eigen::Vector2d(boat.x(), boat.y());
  };
  const Eigen::Vector2d while_waiting = place(0.5, 1.0);
  EXPECT_EQ(place(15.0, 1.0), while_waiting);
  EXPECT_NE(place(15.0, 2.0), while_waiting) << "a new path begins where the boat is";
}

class EveryControlledBoat : public testing::TestWithParam<const char*> {
 protected:
  static control::VesselControlParams control() {
    const std::string vessel = GetParam();
    return shipped_control(vessel.rfind("wamv", 0) == 0 ? "wamv" : vessel);
  }
};

TEST_P(EveryControlledBoat, TurnsToAHeadingWithoutOvershoot) {
  ControlledBoat boat(GetParam(), control());
  boat.command(towards(Kind::kHeading, 2.0));
  double highest = 0.0;
  for (int i = 0; i < 6000; ++i) {
    boat.step();
    highest = std::max(highest, boat.heading());
  }
  EXPECT_NEAR(boat.heading(), 2.0, deg_to_rad(0.5));
  EXPECT_LT(highest, 2.0 + deg_to_rad(3.0));
  EXPECT_NEAR(boat.boat().nu()[0], control().speed.cruise, 0.02);
}

TEST_P(EveryControlledBoat, TurnsAroundToAPathThatLeadsAstern) {
  for (const double degrees : {150.0, 165.0, 178.0, -155.0, -170.0}) {
    const double course = deg_to_rad(degrees);
    ControlledBoat boat(GetParam(), control());
    boat.command(follow({{0.0, 0.0}, {80.0 * std::cos(course), 80.0 * std::sin(course)}}));
    boat.run(40.0);
    EXPECT_LT(std::abs(angle_difference(boat.heading(), course)), deg_to_rad(60.0)) << degrees;
  }
}

TEST_P(EveryControlledBoat, FollowsVelocityCommandsAndStopsWithoutNewOnes) {
  ControlledBoat boat(GetParam(), control());
  for (int i = 0; i < 400; ++i) {
    boat.command(velocity(0.8, 0.15));
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
  boat.command(keep(-30.0, 20.0, 0.5));
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
  boat.command(keep(0.0, 0.0, 1.0));
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
}  // namespace trident::sim
