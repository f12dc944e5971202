// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "quad_world.h"

namespace trident::sim {
namespace {

SimTime state_stamp(std::int64_t step) { return SimTime::from_seconds(0.01) * step; }
const std::vector<double> kSpin(4, 300.0);

/// The number of the step in which the motors first move when the answer to the odometry stamped
/// `stamp` is written after `written_after` steps.
std::uint64_t moves_in_step(LoopTiming timing, SimTime stamp, std::uint64_t written_after) {
  QuadWorld quad({}, timing);
  quad->step(written_after);
  quad.command(kSpin, stamp);
  while (quad->step_count() < 50) {
    quad->step();
    if (std::abs(quad.rotor(1)) > 1.0) return quad->step_count();
  }
  return 0;
}

/// Stamp of the odometry that shows the state after `k` steps, as the controller gets it.
SimTime odometry_stamp(LoopTiming timing, std::uint64_t k) {
  QuadWorld quad({}, timing);
  auto* odometry = quad->ports().find_out<OdometrySample>("quad/odometry");
  odometry->add_listener();
  quad->step(timing == LoopTiming::kRotors ? k + 1 : k);
  const double fallen = -9.8 * 0.01 * 0.01 * 0.5 * static_cast<double>(k * (k + 1));
  EXPECT_NEAR(odometry->value.T_parent_child.p.z(), fallen, 1e-9);
  return odometry->value.stamp;
}

TEST(CommandTiming, RotorsTimingActsThreeStepsAfterTheState) {
  const SimTime stamp = odometry_stamp(LoopTiming::kRotors, 5);
  EXPECT_EQ(stamp, state_stamp(6));
  EXPECT_EQ(moves_in_step(LoopTiming::kRotors, stamp, 6), 5u + 3u);
}

TEST(CommandTiming, DirectTimingActsInTheNextStep) {
  const SimTime stamp = odometry_stamp(LoopTiming::kDirect, 5);
  EXPECT_EQ(stamp, state_stamp(5));
  EXPECT_EQ(moves_in_step(LoopTiming::kDirect, stamp, 5), 5u + 1u);
}

TEST(CommandTiming, TheMomentOfArrivalDoesNotMatterBeforeTheCommandIsDue) {
  EXPECT_EQ(moves_in_step(LoopTiming::kRotors, state_stamp(6), 2), 8u);
  EXPECT_EQ(moves_in_step(LoopTiming::kRotors, state_stamp(6), 6), 8u);
  EXPECT_EQ(moves_in_step(LoopTiming::kRotors, state_stamp(6), 7), 8u);
}

TEST(CommandTiming, ALateCommandActsAtOnce) {
  EXPECT_EQ(moves_in_step(LoopTiming::kRotors, state_stamp(6), 12), 13u);
}

TEST(CommandTiming, AnUnstampedCommandActsAtOnce) {
  EXPECT_EQ(moves_in_step(LoopTiming::kRotors, {}, 4), 5u);
  EXPECT_EQ(moves_in_step(LoopTiming::kDirect, {}, 4), 5u);
}

TEST(CommandTiming, AStampOfAnotherClockCountsAsNone) {
  EXPECT_EQ(moves_in_step(LoopTiming::kRotors, SimTime::from_seconds(1.7e9), 4), 5u);
}

TEST(CommandTiming, OfSeveralDueCommandsTheLatestActs) {
  QuadWorld late, only;
  for (QuadWorld* quad : {&late, &only}) (*quad)->step(10);
  late.command({100, 100, 100, 100}, state_stamp(6));
  late.command({200, 200, 200, 200}, state_stamp(7));
  for (QuadWorld* quad : {&late, &only}) quad->command({300, 300, 300, 300}, state_stamp(8));
  for (QuadWorld* quad : {&late, &only}) (*quad)->step(5);
  EXPECT_EQ(late->state_hash(), only->state_hash());
}

TEST(CommandTiming, EachOfACommandPerStepActsAtItsOwnTime) {
  QuadWorld burst, steady;
  burst->step(6);
  steady->step(6);
  for (int i = 0; i < 3; ++i)
    burst.command(std::vector<double>(4, 100.0 + 100 * i), state_stamp(6 + i));
  for (int i = 0; i < 3; ++i) {
    steady.command(std::vector<double>(4, 100.0 + 100 * i), state_stamp(6 + i));
    steady->step();
  }
  burst->step(3);
  burst->step(10);
  steady->step(10);
  EXPECT_EQ(burst->state_hash(), steady->state_hash());
}

TEST(CommandTiming, ADuplicateChangesNothing) {
  QuadWorld twice, once;
  for (QuadWorld* quad : {&twice, &once}) {
    (*quad)->step(3);
    quad->command(kSpin, state_stamp(3));
  }
  twice.command(kSpin, state_stamp(3));
  for (QuadWorld* quad : {&twice, &once}) (*quad)->step(20);
  EXPECT_EQ(twice->state_hash(), once->state_hash());
}

class BadCommand : public testing::TestWithParam<double> {};

TEST_P(BadCommand, IsReportedOnceAndTheLastGoodOneStays) {
  QuadWorld quad, good;
  for (QuadWorld* one : {&quad, &good}) one->command_all(300.0);
  for (int i = 0; i < 20; ++i) {
    quad->step();
    good->step();
    quad.command({300, 300, GetParam(), 300});
  }
  EXPECT_EQ(quad->state_hash(), good->state_hash());
  EXPECT_EQ(quad.world.report_count(Severity::kError, "motor command 2 is"), 1u);
  EXPECT_EQ(quad.world.report_count(Severity::kError, "must be finite"), 1u);
}
INSTANTIATE_TEST_SUITE_P(Values, BadCommand,
                         testing::Values(std::numeric_limits<double>::quiet_NaN(),
                                         std::numeric_limits<double>::infinity(),
                                         -std::numeric_limits<double>::infinity()));

TEST(CommandTiming, ABadCommandIsReportedAgainAfterAGoodOne) {
  QuadWorld quad;
  for (int i = 0; i < 2; ++i) {
    quad.command_all(std::nan(""));
    quad->step();
    quad.command_all(100.0);
    quad->step();
  }
  EXPECT_EQ(quad.world.report_count(Severity::kError, "must be finite"), 2u);
}

TEST(CommandTiming, ABadCommandStraightToTheMotorsIsRefusedToo) {
  QuadWorld quad;
  quad.command_all(300.0);
  quad->step(5);
  ActuatorCommand bad;
  bad.angular_velocities.assign({std::vector<double>(4, std::nan("")).data(), 4});
  quad->ports().find_in<ActuatorCommand>("quad/gazebo/command/motor_speed")->write(bad);
  quad->step(5);
  EXPECT_TRUE(quad.body().velocity().allFinite());
  EXPECT_GE(quad.world.report_count(Severity::kError, "must be finite"), 1u);
}

TEST(CommandTiming, ACommandForFewerMotorsMovesThoseAndIsReported) {
  QuadWorld quad;
  quad.command_all(300.0);
  quad->step(100);
  quad.command({500, 500});
  quad->step(100);
  EXPECT_NEAR(std::abs(quad.rotor(0)), 500.0, 10.0);
  EXPECT_NEAR(std::abs(quad.rotor(2)), 300.0, 10.0);
  EXPECT_EQ(quad.world.report_count(Severity::kError, "motor 3 is not in a command of 2 speeds"),
            1u);
}

TEST(CommandTiming, WhatTheMotorsGetIsShown) {
  QuadWorld quad;
  auto* shown = quad->ports().find_out<ActuatorState>("quad/gazebo/command/motor_speed");
  shown->add_listener();
  quad->step(2);
  EXPECT_EQ(shown->count(), 0u);  // nothing before the first command
  quad.command({1, 2, 3, 4});
  quad->step(2);
  EXPECT_EQ(shown->count(), 2u);
  EXPECT_EQ(shown->value.angular_velocities.data[3], 4.0);
}

}  // namespace
}  // namespace trident::sim
