// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/autopilot/autopilot.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "autopilot/flown_vehicle.h"

namespace trident::bridges {
namespace {

/// One broken precondition each: what is asked, and the words of the true reason.
struct Refusal {
  const char* name;
  Flavor flavor;
  std::function<Answer(FlownVehicle&)> ask;
  const char* reason;
};

Answer arm_with(FlownVehicle& vehicle, const std::function<void()>& spoil) {
  spoil();
  vehicle.step();
  return vehicle.ask(ArmRequest{});
}

const std::vector<Refusal> kRefusals = {
    {"arm without position", Flavor::kArduPilot,
     [](FlownVehicle&) { return Autopilot({}).handle(ArmRequest{}, {}); },
     "position: none has come"},
    {"arm with an old position", Flavor::kPx4,
     [](FlownVehicle& v) {
       v.has_position = false;
       v.run(1.5);
       return v.ask(ArmRequest{});
     },
     "s old, limit 1 s"},
    {"arm with an unsettled estimator", Flavor::kPx4,
     [](FlownVehicle& v) { return arm_with(v, [&] { v.state.position_stddev_m = 2.5; }); },
     "standard deviation 2.5 m, limit 1 m"},
    {"arm with an empty battery", Flavor::kPx4,
     [](FlownVehicle& v) { return arm_with(v, [&] { v.state.battery = 0.12; }); },
     "battery: 12 %, limit 20 %"},
    {"arm with an empty battery, copter", Flavor::kArduPilot,
     [](FlownVehicle& v) { return arm_with(v, [&] { v.state.battery = 0.19; }); },
     "battery: 19 %, limit 20 %"},
    {"arm outside of the fence", Flavor::kPx4,
     [](FlownVehicle& v) {
       v.pilot.load_fence({{true, {{10, 10}, {20, 10}, {20, 20}}, {0, 0}, 0.0}});
       return v.ask(ArmRequest{});
     },
     "is outside of inclusion 0"},
    {"arm inside of an exclusion", Flavor::kPx4,
     [](FlownVehicle& v) {
       v.pilot.load_fence({{false, {}, {0, 0}, 5.0}});
       return v.ask(ArmRequest{});
     },
     "is inside of exclusion 0"},
    {"arm beyond the fence's radius", Flavor::kPx4,
     [](FlownVehicle& v) {
       v.pilot.set_parameter("GF_MAX_HOR_DIST", 3.0);
       return arm_with(v, [&] { v.state.p_world_m = {4, 0, 0}; });
     },
     "fence: 4 m from home, limit 3 m"},
    {"arm above the fence", Flavor::kPx4,
     [](FlownVehicle& v) {
       v.pilot.set_parameter("GF_MAX_VER_DIST", 3.0);
       return arm_with(v, [&] { v.state.p_world_m = {0, 0, 5}; });
     },
     "fence: 5 m above home, limit 3 m"},
    {"arm in motion", Flavor::kPx4,
     [](FlownVehicle& v) {
       v.state.v_world_m_s = {2, 0, 0};
       v.pilot.step(v.now, v.state);
       return v.ask(ArmRequest{});
     },
     "speed: 2 m/s, limit 0.5 m/s"},
    {"arm in LAND", Flavor::kArduPilot,
     [](FlownVehicle& v) {
       v.mode("LAND");
       return v.ask(ArmRequest{});
     },
     "mode: LAND cannot be armed in"},
    {"OFFBOARD without set-points", Flavor::kPx4,
     [](FlownVehicle& v) { return v.mode("OFFBOARD"); }, "none has come"},
    {"OFFBOARD after one set-point", Flavor::kPx4,
     [](FlownVehicle& v) {
       v.pilot.set_target(place(0, 0, 2), v.now, v.now);
       return v.mode("OFFBOARD");
     },
     "they have come for 0 s"},
    {"OFFBOARD with slow set-points", Flavor::kPx4,
     [](FlownVehicle& v) {
       for (int i = 0; i < 4; ++i) {
         v.pilot.set_target(place(0, 0, 2), v.now, v.now);
         v.run(0.7);
       }
       return v.mode("OFFBOARD");
     },
     "the last is 0.7 s old"},
    {"AUTO without a mission", Flavor::kArduPilot, [](FlownVehicle& v) { return v.mode("AUTO"); },
     "it has 0 items, 1 is needed"},
    {"a mode without position", Flavor::kArduPilot,
     [](FlownVehicle&) { return Autopilot({}).handle(ModeRequest{4}, {}); },
     "Mode GUIDED denied: position: none has come"},
    {"an unknown mode", Flavor::kPx4, [](FlownVehicle& v) { return v.ask(ModeRequest{77}); },
     "Mode 77 is not known, legal: MANUAL"},
    {"take-off disarmed", Flavor::kPx4, [](FlownVehicle& v) { return v.ask(TakeOffRequest{3.0}); },
     "the vehicle is disarmed"},
    {"take-off in STABILIZE", Flavor::kArduPilot,
     [](FlownVehicle& v) {
       v.ask(ArmRequest{});
       return v.ask(TakeOffRequest{3.0});
     },
     "the mode must be GUIDED"},
    {"take-off downwards", Flavor::kPx4,
     [](FlownVehicle& v) { return v.ask(TakeOffRequest{-3.0}); }, "height -3 m, legal: above 0"},
    {"take-off through the fence", Flavor::kPx4,
     [](FlownVehicle& v) {
       v.pilot.set_parameter("GF_MAX_VER_DIST", 3.0);
       v.ask(ArmRequest{});
       return v.ask(TakeOffRequest{8.0});
     },
     "fence: 8 m above home, limit 3 m"},
    {"go to, disarmed", Flavor::kPx4,
     [](FlownVehicle& v) {
       return v.ask(GoToRequest{{1, 1, 1}, std::nullopt, 0.0});
     },
     "the vehicle is disarmed"},
    {"go to nowhere", Flavor::kPx4,
     [](FlownVehicle& v) {
       return v.ask(GoToRequest{{kNan, 1, 1}, std::nullopt, 0.0});
     },
     "the place is not finite"},
    {"mission disarmed", Flavor::kPx4,
     [](FlownVehicle& v) {
       v.pilot.load_mission({waypoint(1, 0, 3)});
       return v.ask(MissionStartRequest{});
     },
     "the vehicle is disarmed"},
    {"mission from an item that is not there", Flavor::kPx4,
     [](FlownVehicle& v) {
       v.pilot.load_mission({waypoint(1, 0, 3)});
       return v.ask(MissionStartRequest{5});
     },
     "mission item 5, legal: 0 to 0"},
    {"disarm in the air", Flavor::kArduPilot,
     [](FlownVehicle& v) {
       v.take_off(3);
       return v.ask(ArmRequest{false, false});
     },
     "is in the air"},
    {"set-point on the ground", Flavor::kArduPilot,
     [](FlownVehicle& v) {
       v.mode("GUIDED");
       v.ask(ArmRequest{});
       return v.pilot.set_target(place(1, 0, 3), v.now, v.now);
     },
     "stands on the ground"},
    {"set-point in another mode", Flavor::kArduPilot,
     [](FlownVehicle& v) { return v.pilot.set_target(place(1, 0, 3), v.now, v.now); },
     "not followed in this mode"},
    {"a speed of zero", Flavor::kPx4, [](FlownVehicle& v) { return v.ask(SpeedRequest{0.0}); },
     "speed: 0 m/s, legal: above 0"},
};

TEST(Autopilot, NamesTheTrueReasonOfEveryRefusal) {
  for (const Refusal& refusal : kRefusals) {
    FlownVehicle vehicle(refusal.flavor);
    const Answer answer = refusal.ask(vehicle);
    EXPECT_FALSE(answer.is_good()) << refusal.name;
    EXPECT_NE(answer.text.find(refusal.reason), std::string::npos)
        << refusal.name << ": " << answer.text;
  }
}

}  // namespace
}  // namespace trident::bridges
