// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/autopilot/autopilot.h"

#include <gtest/gtest.h>

#include <limits>

#include "autopilot/flown_vehicle.h"
#include "trident_base/angle.h"

namespace trident::bridges {
namespace {

TEST(Autopilot, FliesTheDayOfAGroundStation) {
  FlownVehicle copter(Flavor::kArduPilot);
  ASSERT_EQ(copter.mode("GUIDED").result, Result::kAccepted);
  ASSERT_EQ(copter.ask(ArmRequest{}).result, Result::kAccepted);
  ASSERT_EQ(copter.ask(TakeOffRequest{5.0}).result, Result::kAccepted);
  EXPECT_TRUE(copter.run_until([&] { return copter.state.p_world_m.z() > 4.99; }, 30.0));
  EXPECT_FALSE(copter.pilot.is_landed());
  ASSERT_EQ(copter.ask(GoToRequest{{20, 10, 8}, std::nullopt, 0.0}).result, Result::kAccepted);
  const Eigen::Vector3d goal(20, 10, 8);
  EXPECT_TRUE(
      copter.run_until([&] { return (copter.state.p_world_m - goal).norm() < 0.01; }, 60.0));
  ASSERT_EQ(copter.mode("RTL").result, Result::kAccepted);
  EXPECT_TRUE(copter.run_until([&] { return !copter.pilot.is_armed(); }, 120.0));
  EXPECT_LT(copter.state.p_world_m.norm(), 0.05);
  double highest = 0.0;
  for (const auto& p : copter.track) highest = std::max(highest, p.z());
  EXPECT_NEAR(highest, 15.0, 0.1) << "RTL_ALT";
}

TEST(Autopilot, FliesPx4sTakeOffMissionAndReturn) {
  FlownVehicle drone(Flavor::kPx4);
  ASSERT_EQ(drone.pilot
                .load_mission({take_off_item(4), waypoint(10, 0, 4, 2.0), waypoint(10, 10, 6),
                               item_of(mission_command::kReturn)})
                .result,
            Result::kAccepted);
  ASSERT_EQ(drone.ask(ArmRequest{}).result, Result::kAccepted);
  ASSERT_EQ(drone.ask(MissionStartRequest{}).result, Result::kAccepted);
  EXPECT_TRUE(drone.run_until([&] { return !drone.pilot.is_armed(); }, 200.0));
  EXPECT_EQ(drone.reached, (std::vector<int>{0, 1, 2}));
  EXPECT_LT(drone.state.p_world_m.norm(), 0.05);
}

TEST(Autopilot, KeepsToTheLinesOfAMission) {
  FlownVehicle copter(Flavor::kArduPilot);
  copter.pilot.load_mission({take_off_item(5), waypoint(20, 0, 5), waypoint(20, 20, 5)});
  copter.mode("GUIDED");
  copter.ask(ArmRequest{});
  copter.ask(MissionStartRequest{});
  ASSERT_TRUE(copter.run_until([&] { return copter.reached.size() == 3; }, 100.0));
  for (const auto& p : copter.track) {
    const bool climbs = p.head<2>().norm() < 0.01;
    const bool first = std::abs(p.y()) < 0.01 && std::abs(p.z() - 5.0) < 0.01;
    const bool second = std::abs(p.x() - 20.0) < 0.01 && std::abs(p.z() - 5.0) < 0.01;
    EXPECT_TRUE(climbs || first || second) << p.transpose();
  }
}

TEST(Autopilot, JumpsAsOftenAsItShall) {
  FlownVehicle copter(Flavor::kArduPilot);
  copter.pilot.load_mission({take_off_item(3), waypoint(3, 0, 3), waypoint(0, 0, 3),
                             item_of(mission_command::kJump, {1, 2, 0, 0}), waypoint(0, 3, 3)});
  copter.mode("GUIDED");
  copter.ask(ArmRequest{});
  copter.ask(MissionStartRequest{});
  ASSERT_TRUE(copter.run_until([&] { return copter.pilot.mission().current() == 5; }, 200.0));
  EXPECT_EQ(copter.reached, (std::vector<int>{0, 1, 2, 1, 2, 1, 2, 4}));
  EXPECT_TRUE(copter.has_text("Mission is finished"));
}

TEST(Autopilot, StaysForTheTimeOfAnItem) {
  FlownVehicle copter(Flavor::kArduPilot);
  copter.take_off(3);
  copter.pilot.load_mission(
      {waypoint(1, 0, 3, 4.0), item_of(mission_command::kDelay, {3, 0, 0, 0})});
  copter.ask(MissionStartRequest{});
  ASSERT_TRUE(copter.run_until(
      [&] { return (copter.state.p_world_m - Eigen::Vector3d(1, 0, 3)).norm() < 0.01; }));
  const SimTime there = copter.now;
  ASSERT_TRUE(copter.run_until([&] { return !copter.reached.empty(); }));
  EXPECT_NEAR((copter.now - there).seconds(), 4.0, 0.5);
  const SimTime held = copter.now;
  ASSERT_TRUE(copter.run_until([&] { return copter.has_text("finished"); }));
  EXPECT_NEAR((copter.now - held).seconds(), 3.0, 0.1);
}

TEST(Autopilot, FliesCirclesOnTheirRadius) {
  FlownVehicle copter(Flavor::kArduPilot);
  copter.take_off(5);
  MissionItem turns = waypoint(10, 0, 5);
  turns.command = mission_command::kLoiterTurns;
  turns.params = {2, 0, 4, 0};
  copter.pilot.load_mission({turns});
  copter.ask(MissionStartRequest{});
  ASSERT_TRUE(copter.run_until([&] { return !copter.reached.empty(); }, 100.0));
  double turned = 0.0;
  for (std::size_t i = 1; i < copter.track.size(); ++i) {
    const Eigen::Vector2d a = (copter.track[i - 1] - turns.p_world_m).head<2>();
    const Eigen::Vector2d b = (copter.track[i] - turns.p_world_m).head<2>();
    if (std::abs(b.norm() - 4.0) < 0.01 && std::abs(a.norm() - 4.0) < 0.01) {
      turned += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    }
  }
  EXPECT_NEAR(turned, -4.0 * kPi, 0.1) << "clockwise, two turns";
}

TEST(Autopilot, FollowsAStreamOfPlacesWithoutLag) {
  FlownVehicle drone(Flavor::kPx4);
  drone.take_off(5);
  const SimTime start = drone.now;
  double worst = 0.0;
  for (int k = 0; k < 1500; ++k) {
    const double t = (drone.now - start).seconds();
    const Eigen::Vector3d wanted(3.0 * std::cos(t * 2 / 3) - 3.0, 3.0 * std::sin(t * 2 / 3), 5.0);
    if (k % 5 == 0)
      drone.pilot.set_target(place(wanted.x(), wanted.y(), wanted.z()), drone.now, drone.now);
    if (k == 60) {
      ASSERT_EQ(drone.mode("OFFBOARD").result, Result::kAccepted);
    }
    drone.step();
    if (k > 600) worst = std::max(worst, (drone.state.p_world_m - wanted).norm());
  }
  EXPECT_LT(worst, 0.1);
}

TEST(Autopilot, ReturnsWhenOffboardEnds) {
  FlownVehicle drone(Flavor::kPx4);
  drone.take_off(5);
  for (int k = 0; k < 100; ++k) {
    drone.pilot.set_target(place(5, 0, 5), drone.now, drone.now);
    drone.step();
  }
  ASSERT_EQ(drone.mode("OFFBOARD").result, Result::kAccepted);
  drone.run(0.9);
  EXPECT_EQ(drone.pilot.mode(), Mode::kOffboard);
  drone.run(0.3);
  EXPECT_EQ(drone.pilot.mode(), Mode::kReturn);
  EXPECT_TRUE(drone.has_text("limit 1 s"));
}

TEST(Autopilot, CanBeArmedAgainAfterALandingOfPx4) {
  for (const Flavor flavor : {Flavor::kPx4, Flavor::kArduPilot}) {
    FlownVehicle copter(flavor);
    copter.take_off(5);
    copter.ask(LandRequest{});
    ASSERT_TRUE(copter.run_until([&] { return !copter.pilot.is_armed(); }, 60.0));
    const bool is_px4 = flavor == Flavor::kPx4;
    EXPECT_EQ(copter.pilot.mode(), is_px4 ? Mode::kHold : Mode::kLand);
    EXPECT_EQ(copter.ask(ArmRequest{}).is_good(), is_px4);
  }
}

TEST(Autopilot, StopsOnceVelocitiesEnd) {
  FlownVehicle copter(Flavor::kArduPilot);
  copter.take_off(5);
  Target target;
  target.v_m_s = Eigen::Vector3d(2, 0, 0);
  ASSERT_EQ(copter.pilot.set_target(target, copter.now, copter.now).result, Result::kAccepted);
  copter.run(2.9);
  EXPECT_NEAR(copter.state.v_world_m_s.x(), 2.0, 0.01);
  copter.run(3.0);
  EXPECT_NEAR(copter.state.v_world_m_s.norm(), 0.0, 1e-6);
}

TEST(Autopilot, GivesTheVehicleToThePilotWhoMovesAStick) {
  FlownVehicle copter(Flavor::kArduPilot);
  copter.take_off(5);
  copter.pilot.load_mission({waypoint(100, 0, 5)});
  copter.ask(MissionStartRequest{});
  copter.run(3.0);
  Sticks sticks;
  sticks.pitch = 0.2;
  copter.pilot.set_sticks(sticks, copter.now);
  copter.step();
  EXPECT_EQ(copter.pilot.mode(), Mode::kMission) << "within the dead band";
  sticks.pitch = -0.8;
  copter.pilot.set_sticks(sticks, copter.now);
  copter.step();
  EXPECT_EQ(copter.pilot.mode(), Mode::kPosition);
  EXPECT_TRUE(copter.has_text("sticks moved by 80 %, limit 30 %"));
  ASSERT_EQ(copter.mode("AUTO").result, Result::kAccepted) << "returned";
  EXPECT_EQ(copter.pilot.mode(), Mode::kMission);
}

TEST(Autopilot, LandsWhenTheBatteryIsCriticalAndReturnsWhenItIsLow) {
  FlownVehicle copter(Flavor::kArduPilot);
  copter.take_off(5);
  copter.ask(GoToRequest{{30, 0, 5}, std::nullopt, 0.0});
  copter.run(15.0);
  copter.state.battery = 0.19;
  copter.step();
  EXPECT_EQ(copter.pilot.mode(), Mode::kReturn);
  EXPECT_TRUE(copter.has_text("battery 19 %, low below 20 %"));
  copter.state.battery = 0.06;
  copter.step();
  EXPECT_EQ(copter.pilot.mode(), Mode::kLand);
  EXPECT_TRUE(copter.run_until([&] { return !copter.pilot.is_armed(); }, 60.0));
}

TEST(Autopilot, HoldsAtItsFence) {
  FlownVehicle drone(Flavor::kPx4);
  ASSERT_EQ(drone.pilot.set_parameter("GF_MAX_HOR_DIST", 10.0).result, Result::kAccepted);
  drone.take_off(5);
  EXPECT_EQ(drone.ask(GoToRequest{{30, 0, 5}, std::nullopt, 0.0}).text,
            "go to: fence: 30 m from home, limit 10 m");
  drone.pilot.load_mission({waypoint(30, 0, 5)});
  drone.ask(MissionStartRequest{});
  ASSERT_TRUE(drone.run_until([&] { return drone.pilot.mode() == Mode::kHold; }, 30.0));
  drone.run(10.0);
  EXPECT_LT(drone.state.p_world_m.x(), 20.0);
  EXPECT_GT(drone.state.p_world_m.x(), 10.0);
}

TEST(Autopilot, ActsWhenTheGroundStationIsSilent) {
  FlownVehicle drone(Flavor::kPx4);
  ASSERT_EQ(drone.pilot.set_parameter("NAV_DLL_ACT", 2).result, Result::kAccepted);
  drone.take_off(5);
  drone.pilot.note_ground_station(drone.now);
  drone.run(9.9);
  EXPECT_NE(drone.pilot.mode(), Mode::kReturn);
  drone.run(0.2);
  EXPECT_EQ(drone.pilot.mode(), Mode::kReturn);
}

TEST(Autopilot, DrivesARoverAlongItsMission) {
  FlownVehicle rover(Flavor::kArduPilot, VehicleClass::kGround);
  ASSERT_EQ(rover.pilot.load_mission({waypoint(10, 0, 0), waypoint(10, 10, 0)}).result,
            Result::kAccepted);
  rover.ask(ArmRequest{});
  ASSERT_EQ(rover.ask(MissionStartRequest{}).result, Result::kAccepted);
  ASSERT_TRUE(rover.run_until([&] { return rover.reached.size() == 2; }, 60.0));
  EXPECT_EQ(rover.pilot.setpoint().kind, Setpoint::Kind::kStation);
  ASSERT_EQ(rover.mode("RTL").result, Result::kAccepted);
  EXPECT_TRUE(rover.run_until([&] { return rover.state.p_world_m.norm() < 2.0; }, 60.0));
  EXPECT_EQ(rover.ask(TakeOffRequest{3.0}).result, Result::kUnsupported);
}

TEST(Autopilot, ArmsAgainstAllChecksWhenForced) {
  FlownVehicle vehicle(Flavor::kArduPilot);
  vehicle.state.battery = 0.01;
  vehicle.step();
  EXPECT_FALSE(vehicle.ask(ArmRequest{}).is_good());
  EXPECT_TRUE(vehicle.ask(ArmRequest{true, true}).is_good());
}

TEST(Autopilot, GivesIdleSetPointsWhileDisarmed) {
  FlownVehicle vehicle(Flavor::kPx4);
  vehicle.run(1.0);
  EXPECT_EQ(vehicle.pilot.setpoint().kind, Setpoint::Kind::kIdle);
}

TEST(Autopilot, KeepsItsMissionWhenANewOneIsRefused) {
  FlownVehicle vehicle(Flavor::kPx4);
  ASSERT_TRUE(vehicle.pilot.load_mission({waypoint(1, 0, 3)}).is_good());
  const Answer answer = vehicle.pilot.load_mission({waypoint(2, 0, 3), item_of(9999)});
  EXPECT_EQ(answer.result, Result::kUnsupported);
  EXPECT_EQ(answer.text, "mission item 1: command 9999 is not known");
  EXPECT_EQ(vehicle.pilot.load_mission({waypoint(kNan, 0, 3)}).result, Result::kDenied);
  EXPECT_EQ(vehicle.pilot.mission().size(), 1);
}

TEST(Autopilot, EndsMissionsThatJumpForEver) {
  FlownVehicle copter(Flavor::kArduPilot);
  copter.take_off(3);
  ASSERT_TRUE(
      copter.pilot.load_mission({item_of(mission_command::kJump, {0, -1, 0, 0})}).is_good());
  copter.ask(MissionStartRequest{});
  copter.run(1.0);
  EXPECT_EQ(copter.pilot.mission().current(), 0) << "it jumps, and every step ends";
}

}  // namespace
}  // namespace trident::bridges
