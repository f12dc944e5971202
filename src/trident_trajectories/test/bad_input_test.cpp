// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "team_problems.h"
#include "trident_base/error.h"
#include "trident_trajectories/optimize.h"

namespace trident::trajectories {
namespace {

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string refusal_of(const std::function<void(Problem&)>& spoil) {
  Problem problem = everything();
  spoil(problem);
  return refusal([&] { validate(problem); });
}

TEST(BadInput, ALegalProblemIsNotRefused) {
  EXPECT_EQ(refusal_of([](Problem&) {}), "");
}

TEST(BadInput, AStartInsideAnObstacleNamesRobotDistanceAndRadius) {
  const std::string text = refusal_of([](Problem& problem) {
    problem.robots[1].start.p = {-5.0, 1.2, 0.0};
  });
  EXPECT_EQ(text,
            "robot 'ugv': distance of the start to an obstacle is -0.3; legal is >= its "
            "collision_radius 0.500000");
}

TEST(BadInput, TimesOfAPredictionMustGrow) {
  const std::string text = refusal([] {
    Prediction(
        {{0.0, {0, 0, 0}, {0, 0, 0}}, {2.0, {0, 0, 0}, {0, 0, 0}}, {2.0, {1, 0, 0}, {0, 0, 0}}});
  });
  EXPECT_EQ(text, "prediction: knot 2: t is 2.000000; legal are times after 2.000000");
}

TEST(BadInput, NotANumberNamesTheField) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal_of([&](Problem& problem) { problem.robots[0].start.p.y() = nan; }),
            "robot 'uav' start: position.y is nan; legal is -1e6 ... 1e6");
  EXPECT_EQ(refusal_of([&](Problem& problem) { problem.robots[0].limits.max_velocity = nan; }),
            "robot 'uav': max_velocity is nan; legal is 0.001 ... 1e6");
  EXPECT_EQ(refusal_of([&](Problem& problem) { problem.durations[1].value = nan; }),
            "duration 1: value is nan; legal is 0.001 ... 1e6");
}

TEST(BadInput, UnknownNamesListTheLegalOnes) {
  EXPECT_EQ(refusal([] { kind_of_name("submarine"); }),
            "kind is 'submarine'; legal are uav, unicycle, ackermann, vessel, ugv, usv");
  EXPECT_EQ(refusal([] { cost_of_name("beauty"); }),
            "cost is 'beauty'; legal are jerk, length, time, energy, mixed");
  OptimizeOptions options;
  options.method = "cobyla";
  EXPECT_EQ(refusal([&] { optimize(antipodal_swap(2), options); }),
            "method is 'cobyla'; legal are auglag, mma, ccsaq, slsqp");
}

TEST(BadInput, NumbersOutOfRangeNameTheirRange) {
  EXPECT_EQ(refusal_of([](Problem& problem) { problem.robots[2].duration = 2; }),
            "robot 'usv': duration is 2; legal is 0 ... 1");
  EXPECT_EQ(refusal_of([](Problem& problem) { problem.rendezvous[0].fraction = 1.5; }),
            "rendezvous 0: fraction is 1.5; legal is 0 ... 1");
  EXPECT_EQ(refusal_of([](Problem& problem) { problem.robots[1].name = "uav"; }),
            "robots: 'uav' is there twice; legal are unique names");
  OptimizeOptions options;
  options.segments = 3;
  EXPECT_EQ(refusal([&] { optimize(antipodal_swap(2), options); }),
            "options: segments is 3.000000; legal is 4 ... 60");
}

}  // namespace
}  // namespace trident::trajectories
