// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/autopilot/rover_steering.h"

#include <gtest/gtest.h>

#include "autopilot/obedient_body.h"
#include "trident_bridges/autopilot/drive_guide.h"

namespace trident::bridges {
namespace {

Setpoint leg(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double speed_m_s) {
  Setpoint setpoint;
  setpoint.kind = Setpoint::Kind::kLeg;
  setpoint.p_from_m = from;
  setpoint.p_m = to;
  setpoint.speed_m_s = speed_m_s;
  return setpoint;
}

/// Drives as commanded for a time; returns the largest distance to the leg in its last half.
double follow(const Setpoint& setpoint, double time_s, VehicleState& state) {
  constexpr double kStep_s = 0.02;
  const Eigen::Vector2d along = (setpoint.p_m - setpoint.p_from_m).head<2>().normalized();
  double off_m = 0.0;
  for (double t = 0.0; t < time_s; t += kStep_s) {
    const Drive drive = steer(setpoint, state);
    Setpoint command;
    command.kind = Setpoint::Kind::kDrive;
    command.speed_m_s = drive.speed_m_s;
    command.yaw_rate = drive.yaw_rate;
    obey(command, kStep_s, state);
    const Eigen::Vector2d from = (state.p_world_m - setpoint.p_from_m).head<2>();
    if (t > 0.5 * time_s) {
      off_m = std::max(off_m, std::abs(along.x() * from.y() - along.y() * from.x()));
    }
  }
  return off_m;
}

TEST(RoverSteering, ALegIsReachedFromBothItsSidesAndFromBehind) {
  for (const Eigen::Vector3d& begin :
       {Eigen::Vector3d(0, 3, 0), Eigen::Vector3d(0, -4, 0), Eigen::Vector3d(24, 1, 0)}) {
    VehicleState state;
    state.p_world_m = begin;
    const Setpoint setpoint = leg({0, 0, 0}, {20, 0, 0}, 1.5);
    EXPECT_LT(follow(setpoint, 40.0, state), 0.15) << begin.transpose();
    EXPECT_LT((state.p_world_m - setpoint.p_m).norm(), 0.25) << begin.transpose();
    EXPECT_EQ(steer(setpoint, state).speed_m_s, 0.0);
  }
}

TEST(RoverSteering, ItTurnsBeforeItDrivesBackwards) {
  VehicleState state;
  const Drive drive = steer(leg({0, 0, 0}, {-10, 0.1, 0}, 1.5), state);
  EXPECT_EQ(drive.speed_m_s, 0.0);
  EXPECT_DOUBLE_EQ(drive.yaw_rate, 1.0);
}

TEST(RoverSteering, AStationAndADisarmedVehicleAreAtRest) {
  Setpoint setpoint;
  for (const auto kind : {Setpoint::Kind::kIdle, Setpoint::Kind::kStation}) {
    setpoint.kind = kind;
    setpoint.p_m = {5, 5, 0};
    setpoint.speed_m_s = 2.0;
    const Drive drive = steer(setpoint, {});
    EXPECT_EQ(drive.speed_m_s, 0.0);
    EXPECT_EQ(drive.yaw_rate, 0.0);
  }
}

TEST(DriveGuide, AVelocityLastsForThreeSeconds) {
  DriveGuide guide;
  Target target;
  target.v_m_s = Eigen::Vector3d(1.0, 0.0, 0.0);
  guide.follow(target, {}, SimTime::from_seconds(1.0));
  guide.expire({}, SimTime::from_seconds(4.0));
  EXPECT_EQ(guide.setpoint().kind, Setpoint::Kind::kDrive);
  guide.expire({}, SimTime::from_seconds(4.1));
  EXPECT_EQ(guide.setpoint().kind, Setpoint::Kind::kStation);
  guide.take_sticks({});
  guide.expire({}, SimTime::from_seconds(100.0));
  EXPECT_EQ(guide.setpoint().kind, Setpoint::Kind::kDrive);
}

}  // namespace
}  // namespace trident::bridges
