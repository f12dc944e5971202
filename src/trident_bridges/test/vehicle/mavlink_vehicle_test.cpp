// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/vehicle/mavlink_vehicle.h"

#include <gtest/gtest.h>

#include <cmath>

#include "trident_bridges/mavlink/dialect.h"
#include "vehicle/ground_station.h"

namespace trident::bridges::mavlink {
namespace {

using testing::FlownMavlinkVehicle;
using testing::kNan;
using testing::kOrigin;

/// An item in the world, with its height above home.
MissionItem item_at(std::uint16_t command, const Eigen::Vector3d& p_m, float param1 = 0.0F) {
  const GeoPlace place = GeoFrame(kOrigin).to_geo(p_m);
  MissionItem item;
  item.command = command;
  item.frame = MAV_FRAME_GLOBAL_RELATIVE_ALT;
  item.params[0] = param1;
  item.x = static_cast<std::int32_t>(std::lround(1e7 * place.latitude_deg));
  item.y = static_cast<std::int32_t>(std::lround(1e7 * place.longitude_deg));
  item.z = static_cast<float>(p_m.z());
  return item;
}

MissionItem return_item() {
  MissionItem item;
  item.command = MAV_CMD_NAV_RETURN_TO_LAUNCH;
  item.frame = MAV_FRAME_MISSION;
  return item;
}

TEST(MavlinkVehicle, ArmsTakesOffLandsAndDisarmsByCommands) {
  FlownMavlinkVehicle drone(VehicleKind::kQuadrotor, AutopilotFlavour::kPx4);
  EXPECT_EQ(drone.command(MAV_CMD_COMPONENT_ARM_DISARM, {1}).result, CommandResult::kAccepted);
  EXPECT_EQ(drone.command(MAV_CMD_NAV_TAKEOFF, {0, 0, 0, kNan, kNan, kNan, kOrigin.altitude_m + 5})
                .result,
            CommandResult::kAccepted);
  EXPECT_TRUE(drone.run_until([&] { return drone.state.p_world_m.z() > 4.95; }, 30.0));
  drone.run(2.0);
  const auto heartbeat = unpack<mavlink_heartbeat_t>(*drone.newest(MAVLINK_MSG_ID_HEARTBEAT));
  EXPECT_EQ(heartbeat.type, MAV_TYPE_QUADROTOR);
  EXPECT_NE(heartbeat.base_mode & MAV_MODE_FLAG_SAFETY_ARMED, 0);
  EXPECT_EQ(heartbeat.system_status, MAV_STATE_ACTIVE);
  const auto air =
      unpack<mavlink_extended_sys_state_t>(*drone.newest(MAVLINK_MSG_ID_EXTENDED_SYS_STATE));
  EXPECT_EQ(air.landed_state, MAV_LANDED_STATE_IN_AIR);
  EXPECT_EQ(drone.command(MAV_CMD_NAV_LAND).result, CommandResult::kAccepted);
  EXPECT_TRUE(drone.run_until([&] { return !drone.vehicle.autopilot().is_armed(); }, 60.0));
  EXPECT_TRUE(drone.has_text("Disarmed: landed."));
  drone.run(1.1);
  const auto ground =
      unpack<mavlink_extended_sys_state_t>(*drone.newest(MAVLINK_MSG_ID_EXTENDED_SYS_STATE));
  EXPECT_EQ(ground.landed_state, MAV_LANDED_STATE_ON_GROUND);
}

TEST(MavlinkVehicle, FliesAMissionThatWasUploadedAndReturns) {
  FlownMavlinkVehicle drone(VehicleKind::kQuadrotor, AutopilotFlavour::kPx4);
  const Mission mission{item_at(MAV_CMD_NAV_TAKEOFF, {0, 0, 5}),
                        item_at(MAV_CMD_NAV_WAYPOINT, {20, 0, 5}, 1.0F),
                        item_at(MAV_CMD_NAV_WAYPOINT, {20, 15, 8}), return_item()};
  const MissionVerdict verdict = drone.upload(MissionType::kMission, mission);
  ASSERT_TRUE(verdict.is_accepted()) << verdict.reason;
  EXPECT_EQ(drone.download(MissionType::kMission), mission);
  EXPECT_EQ(drone.command(MAV_CMD_COMPONENT_ARM_DISARM, {1}).result, CommandResult::kAccepted);
  EXPECT_EQ(drone.command(MAV_CMD_MISSION_START).result, CommandResult::kAccepted);
  const Eigen::Vector3d first(20, 0, 5), second(20, 15, 8);
  EXPECT_TRUE(drone.run_until([&] { return (drone.state.p_world_m - first).norm() < 0.3; }));
  EXPECT_TRUE(drone.run_until([&] { return (drone.state.p_world_m - second).norm() < 0.3; }));
  EXPECT_TRUE(drone.run_until([&] { return !drone.vehicle.autopilot().is_armed(); }));
  EXPECT_LT(drone.state.p_world_m.norm(), 0.3);
  const auto reached =
      unpack<mavlink_mission_item_reached_t>(*drone.newest(MAVLINK_MSG_ID_MISSION_ITEM_REACHED));
  EXPECT_EQ(reached.seq, 2);
  EXPECT_EQ(drone.counts[MAVLINK_MSG_ID_MISSION_ITEM_REACHED], 3);
}

TEST(MavlinkVehicle, ItemZeroOfArduPilotIsHome) {
  FlownMavlinkVehicle boat(VehicleKind::kBoat, AutopilotFlavour::kArdupilot);
  const MissionItem far = item_at(MAV_CMD_NAV_WAYPOINT, {500, 0, 0});
  const Mission mission{far, item_at(MAV_CMD_NAV_WAYPOINT, {30, 0, 0})};
  ASSERT_TRUE(boat.upload(MissionType::kMission, mission).is_accepted());
  const Mission downloaded = boat.download(MissionType::kMission);
  ASSERT_EQ(downloaded.size(), 2U);
  EXPECT_NEAR(downloaded[0].x, 1e7 * kOrigin.latitude_deg, 1.0);
  EXPECT_EQ(downloaded[1], mission[1]);
  EXPECT_EQ(boat.command(MAV_CMD_COMPONENT_ARM_DISARM, {1}).result, CommandResult::kAccepted);
  EXPECT_EQ(boat.command(MAV_CMD_DO_SET_MODE, {1, 10}).result, CommandResult::kAccepted);
  ASSERT_TRUE(boat.run_until([&] { return boat.counts[MAVLINK_MSG_ID_MISSION_ITEM_REACHED] > 0; }));
  EXPECT_LT((boat.state.p_world_m - Eigen::Vector3d(30, 0, 0)).norm(), 3.0);
  const auto reached =
      unpack<mavlink_mission_item_reached_t>(*boat.newest(MAVLINK_MSG_ID_MISSION_ITEM_REACHED));
  EXPECT_EQ(reached.seq, 1);
}

TEST(MavlinkVehicle, HeightsOfAMissionFollowTheHomeOfArming) {
  FlownMavlinkVehicle drone(VehicleKind::kQuadrotor, AutopilotFlavour::kPx4);
  ASSERT_TRUE(drone
                  .upload(MissionType::kMission, {item_at(MAV_CMD_NAV_TAKEOFF, {0, 0, 5}),
                                                  item_at(MAV_CMD_NAV_WAYPOINT, {5, 0, 6})})
                  .is_accepted());
  drone.state.p_world_m.z() = 2.0;  // carried onto a roof
  drone.run(0.1);
  drone.command(MAV_CMD_COMPONENT_ARM_DISARM, {1});
  ASSERT_TRUE(drone.vehicle.autopilot().home());
  const double home_m = drone.vehicle.autopilot().home()->z();
  EXPECT_NEAR(home_m, 2.0, 0.01);
  EXPECT_NEAR(drone.vehicle.autopilot().mission().items()[1].p_world_m.z(), home_m + 6.0, 0.01);
}

TEST(MavlinkVehicle, ARefusalIsGivenOnceWithItsReason) {
  FlownMavlinkVehicle drone(VehicleKind::kQuadrotor, AutopilotFlavour::kPx4);
  drone.state.battery = 0.1;
  drone.run(0.1);
  EXPECT_EQ(drone.command(MAV_CMD_COMPONENT_ARM_DISARM, {1}).result,
            CommandResult::kTemporarilyRejected);
  EXPECT_EQ(drone.count_texts("Arming denied: battery: 10 %, limit 20 %"), 1);
  EXPECT_EQ(drone.command(MAV_CMD_DO_SET_PARAMETER, {1}).result, CommandResult::kUnsupported);
  EXPECT_EQ(drone.count_texts("command 180"), 1);
  EXPECT_EQ(drone.command(MAV_CMD_COMPONENT_ARM_DISARM, {7}).result, CommandResult::kDenied);
  EXPECT_EQ(drone.count_texts("command 400: param1 7, legal: 0 or 1"), 1);
}

TEST(MavlinkVehicle, ARefusedMissionLeavesTheOldOne) {
  FlownMavlinkVehicle rover(VehicleKind::kRover, AutopilotFlavour::kArdupilot);
  const Mission good{item_at(MAV_CMD_NAV_WAYPOINT, {0, 0, 0}),
                     item_at(MAV_CMD_NAV_WAYPOINT, {5, 0, 0})};
  ASSERT_TRUE(rover.upload(MissionType::kMission, good).is_accepted());
  Mission bad = good;
  bad.push_back(item_at(MAV_CMD_NAV_TAKEOFF, {5, 0, 5}));
  EXPECT_EQ(rover.upload(MissionType::kMission, bad).result, MissionResult::kUnsupported);
  EXPECT_TRUE(rover.has_text("mission item 2: command 22 is only for vehicles that fly"));
  EXPECT_EQ(rover.download(MissionType::kMission).size(), 2U);
  EXPECT_EQ(rover.vehicle.autopilot().mission().size(), 2);
}

TEST(MavlinkVehicle, AFenceThatWasUploadedKeepsFromArmingOutside) {
  FlownMavlinkVehicle drone(VehicleKind::kQuadrotor, AutopilotFlavour::kPx4);
  ASSERT_TRUE(drone
                  .upload(MissionType::kFence,
                          {item_at(MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION, {100, 0, 0}, 20.0F)})
                  .is_accepted());
  EXPECT_EQ(drone.command(MAV_CMD_COMPONENT_ARM_DISARM, {1}).result,
            CommandResult::kTemporarilyRejected);
  EXPECT_TRUE(drone.has_text("inclusion 0"));
  const Mission corners(2, item_at(MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION, {0, 0, 0}, 4.0F));
  EXPECT_EQ(drone.upload(MissionType::kFence, corners).result, MissionResult::kInvalidParam1);
  ASSERT_TRUE(drone.upload(MissionType::kFence, {}).is_accepted());
  EXPECT_EQ(drone.command(MAV_CMD_COMPONENT_ARM_DISARM, {1}).result, CommandResult::kAccepted);
}

TEST(MavlinkVehicle, ACircleWithoutARadiusDoesNotCount) {
  FlownMavlinkVehicle drone(VehicleKind::kQuadrotor, AutopilotFlavour::kPx4);
  Mission fence;
  for (const auto& [x, y] : {std::pair(9, 9), std::pair(9, -9), std::pair(-9, 0)}) {
    const Eigen::Vector3d corner(x, y, 0);
    fence.push_back(item_at(MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION, corner, 3.0F));
  }
  fence.push_back({});
  fence.back().command = MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION;
  fence.back().frame = MAV_FRAME_GLOBAL;
  const MissionVerdict verdict = drone.upload(MissionType::kFence, fence);
  ASSERT_TRUE(verdict.is_accepted()) << verdict.reason;
  EXPECT_EQ(drone.download(MissionType::kFence), fence);
  EXPECT_EQ(drone.count_texts("circles of radius 0 do not count: 1, from item 3"), 1);
  EXPECT_EQ(drone.command(MAV_CMD_COMPONENT_ARM_DISARM, {1}).result, CommandResult::kAccepted);
}

TEST(MavlinkVehicle, AParameterThatIsSetCounts) {
  for (const auto flavour : {AutopilotFlavour::kPx4, AutopilotFlavour::kArdupilot}) {
    FlownMavlinkVehicle drone(VehicleKind::kQuadrotor, flavour);
    bool is_done = false;
    drone.parameters.fetch(drone.now, [&](bool good, const std::string&) { is_done = good; });
    ASSERT_TRUE(drone.run_until([&] { return is_done; }, 20.0));
    EXPECT_EQ(drone.parameters.parameters().size(),
              drone.vehicle.autopilot().parameters().all().size());
    const char* const name = flavour == AutopilotFlavour::kPx4 ? "RTL_RETURN_ALT" : "RTL_ALT";
    const double value = flavour == AutopilotFlavour::kPx4 ? 9.0 : 900.0;
    is_done = false;
    drone.parameters.set(name, value, drone.now,
                         [&](bool good, const std::string&) { is_done = good; });
    ASSERT_TRUE(drone.run_until([&] { return is_done; }, 20.0)) << name;
    EXPECT_EQ(drone.vehicle.autopilot().parameters().value(name), value);
  }
}

TEST(MavlinkVehicle, TelemetryComesAtItsRatesAndSaysWhereTheVehicleIs) {
  FlownMavlinkVehicle boat(VehicleKind::kBoat, AutopilotFlavour::kArdupilot);
  boat.state.p_world_m = {30, 40, 0};
  boat.counts.clear();
  boat.run(10.0);
  EXPECT_NEAR(boat.counts[MAVLINK_MSG_ID_HEARTBEAT], 10, 1);
  EXPECT_NEAR(boat.counts[MAVLINK_MSG_ID_ATTITUDE], 250, 2);
  EXPECT_NEAR(boat.counts[MAVLINK_MSG_ID_GLOBAL_POSITION_INT], 100, 2);
  const auto local =
      unpack<mavlink_local_position_ned_t>(*boat.newest(MAVLINK_MSG_ID_LOCAL_POSITION_NED));
  EXPECT_NEAR(local.x, 40.0, 1e-4);
  EXPECT_NEAR(local.y, 30.0, 1e-4);
  const auto global =
      unpack<mavlink_global_position_int_t>(*boat.newest(MAVLINK_MSG_ID_GLOBAL_POSITION_INT));
  const Eigen::Vector3d p = GeoFrame(kOrigin).to_world({global.lat / 1e7, global.lon / 1e7, 488.0});
  EXPECT_NEAR(p.x(), 30.0, 0.02);
  EXPECT_NEAR(p.y(), 40.0, 0.02);
  EXPECT_EQ(global.hdg, 9000) << "east";
  const auto battery = unpack<mavlink_sys_status_t>(*boat.newest(MAVLINK_MSG_ID_SYS_STATUS));
  EXPECT_EQ(battery.battery_remaining, 90);
  EXPECT_EQ(boat.command(MAV_CMD_SET_MESSAGE_INTERVAL, {MAVLINK_MSG_ID_ATTITUDE, 1e6}).result,
            CommandResult::kAccepted);
  boat.counts.clear();
  boat.run(10.0);
  EXPECT_NEAR(boat.counts[MAVLINK_MSG_ID_ATTITUDE], 10, 1);
}

TEST(MavlinkVehicle, FollowsPlacesOfACompanionOnceTheyCome) {
  FlownMavlinkVehicle drone(VehicleKind::kQuadrotor, AutopilotFlavour::kPx4);
  mavlink_set_mode_t mode{};
  mode.target_system = 1;
  mode.base_mode = MAV_MODE_FLAG_CUSTOM_MODE_ENABLED;
  mode.custom_mode = 6U << 16;
  drone.send(pack(mode, FlownMavlinkVehicle::kSelf));
  drone.run(0.1);
  EXPECT_EQ(drone.count_texts("Mode OFFBOARD denied"), 1);
  mavlink_set_position_target_local_ned_t target{};
  target.target_system = 1;
  target.coordinate_frame = MAV_FRAME_LOCAL_NED;
  target.type_mask = 0xDF8;
  target.x = 4.0F;
  target.z = -3.0F;
  const auto stream = [&](double time_s) {
    for (int i = 0; i < static_cast<int>(time_s * 50.0); ++i) {
      if (i % 5 == 0) drone.send(pack(target, FlownMavlinkVehicle::kSelf));
      drone.step();
    }
  };
  stream(2.0);
  drone.send(pack(mode, FlownMavlinkVehicle::kSelf));
  stream(0.2);
  EXPECT_EQ(drone.vehicle.autopilot().mode(), Mode::kOffboard);
  Command arm;
  arm.command = MAV_CMD_COMPONENT_ARM_DISARM;
  arm.params[0] = 1.0;
  drone.commands.send(drone.vehicle.address(), arm, drone.now, [](const CommandOutcome&) {});
  stream(15.0);
  EXPECT_LT((drone.state.p_world_m - Eigen::Vector3d(0, 4, 3)).norm(), 0.1)
      << drone.state.p_world_m.transpose();
}

TEST(MavlinkVehicle, PassesItemsForPayloadsAndSaysSo) {
  FlownMavlinkVehicle drone(VehicleKind::kQuadrotor, AutopilotFlavour::kPx4);
  Mission mission{item_at(MAV_CMD_NAV_TAKEOFF, {0, 0, 3}),
                  item_at(MAV_CMD_NAV_WAYPOINT, {5, 0, 3})};
  MissionItem picture;
  picture.command = MAV_CMD_IMAGE_START_CAPTURE;
  picture.frame = MAV_FRAME_MISSION;
  mission.insert(mission.begin() + 1, picture);
  ASSERT_TRUE(drone.upload(MissionType::kMission, mission).is_accepted());
  EXPECT_EQ(drone.count_texts("relays have no effect: 1, from item 1 (command 2000)"), 1);
  drone.command(MAV_CMD_COMPONENT_ARM_DISARM, {1});
  EXPECT_EQ(drone.command(MAV_CMD_MISSION_START, {kNan, kNan}).result, CommandResult::kAccepted);
  EXPECT_TRUE(drone.run_until([&] { return drone.has_text("Mission is finished."); }, 60.0));
  EXPECT_NEAR(drone.state.p_world_m.x(), 5.0, 0.3);
}

/// A place 3 m above the ground, 4 m north.
Message place_to_hold() {
  mavlink_set_position_target_local_ned_t target{};
  target.target_system = 1;
  target.coordinate_frame = MAV_FRAME_LOCAL_NED;
  target.type_mask = 0xDF8;
  target.x = 4.0F;
  target.z = -3.0F;
  return pack(target, FlownMavlinkVehicle::kSelf);
}

/// As MAVSDK does it: one set-point, OFFBOARD asked for at once, further set-points meanwhile.
struct HastyClient {
  HastyClient() {
    drone.send(place_to_hold());
    Command mode;
    mode.command = MAV_CMD_DO_SET_MODE;
    mode.params = {1.0, 6.0};
    drone.commands.send(drone.vehicle.address(), mode, drone.now,
                        [this](const CommandOutcome& end) { outcome = end; });
  }
  /// With set-points at 20 Hz until it is answered; the time that it took [s].
  double stream(int most) {
    const SimTime start = drone.now;
    for (int i = 0; i < most && !outcome; ++i) {
      drone.send(place_to_hold());
      drone.run_until([&] { return outcome.has_value(); }, 0.05);
    }
    return (drone.now - start).seconds();
  }
  FlownMavlinkVehicle drone{VehicleKind::kQuadrotor, AutopilotFlavour::kPx4};
  std::optional<CommandOutcome> outcome;
};

TEST(MavlinkVehicle, EntersOffboardOnceSetPointsHaveComeForASecond) {
  HastyClient client;
  EXPECT_NEAR(client.stream(100), 1.0, 0.1);
  ASSERT_TRUE(client.outcome);
  EXPECT_EQ(client.outcome->reply.result, CommandResult::kAccepted);
  EXPECT_EQ(client.drone.vehicle.autopilot().mode(), Mode::kOffboard);
  EXPECT_FALSE(client.drone.has_text("denied"));
}

TEST(MavlinkVehicle, RefusesOffboardWhenSetPointsEndBefore) {
  HastyClient client;
  client.stream(6);
  ASSERT_FALSE(client.outcome);
  client.drone.run(1.0);
  ASSERT_TRUE(client.outcome);
  EXPECT_EQ(client.outcome->reply.result, CommandResult::kTemporarilyRejected);
  EXPECT_EQ(client.drone.count_texts("the last is 0.5 s old"), 1);
}

TEST(MavlinkVehicle, ForgetsOffboardWhenAnotherModeIsAskedFor) {
  HastyClient client;
  client.stream(6);
  mavlink_set_mode_t mode{};
  mode.target_system = 1;
  mode.base_mode = MAV_MODE_FLAG_CUSTOM_MODE_ENABLED;
  mode.custom_mode = 3U << 16;
  client.drone.send(pack(mode, FlownMavlinkVehicle::kSelf));
  client.stream(40);
  ASSERT_TRUE(client.outcome);
  EXPECT_EQ(client.outcome->reply.result, CommandResult::kCancelled);
  EXPECT_EQ(client.drone.vehicle.autopilot().mode(), Mode::kPosition);
}

TEST(MavlinkVehicle, KeepsOffboardWhileSetPointsComeAtTheWallsRate) {
  HastyClient client;
  client.stream(100);
  FlownMavlinkVehicle& drone = client.drone;
  ASSERT_EQ(drone.command(MAV_CMD_COMPONENT_ARM_DISARM, {1}).result, CommandResult::kAccepted);
  // 20 Hz, where the simulation is 40 times as fast: each 2 s of its time.
  double wall_s = 1.0;
  const auto run = [&](double time_s) {
    for (int i = 0; i < std::lround(time_s / 0.02); ++i) {
      drone.now = drone.now + SimTime{20'000'000};
      wall_s += 0.02 / 40.0;
      drone.state.position_stamp = drone.now;
      drone.vehicle.update({drone.now, SimTime::from_seconds(wall_s)});
      drone.vehicle.step(drone.now, drone.state);
    }
  };
  for (int i = 0; i < 10; ++i) {
    drone.vehicle.handle(place_to_hold(), {drone.now, SimTime::from_seconds(wall_s)});
    run(2.0);
  }
  EXPECT_EQ(drone.vehicle.autopilot().mode(), Mode::kOffboard);
  run(42.0);
  EXPECT_EQ(drone.vehicle.autopilot().mode(), Mode::kReturn) << "silent by both clocks";
}

TEST(MavlinkVehicle, SticksDriveARover) {
  FlownMavlinkVehicle rover(VehicleKind::kRover, AutopilotFlavour::kArdupilot);
  ASSERT_EQ(rover.command(MAV_CMD_COMPONENT_ARM_DISARM, {1}).result, CommandResult::kAccepted);
  mavlink_rc_channels_override_t channels{};
  channels.target_system = 1;
  channels.chan1_raw = channels.chan2_raw = channels.chan4_raw = 1500;
  channels.chan3_raw = 2000;
  for (int i = 0; i < 100; ++i) {
    rover.send(pack(channels, FlownMavlinkVehicle::kSelf));
    rover.step();
  }
  EXPECT_GT(rover.state.p_world_m.x(), 0.5);
}

TEST(MavlinkVehicle, AnswersWhatEveryClientAsks) {
  FlownMavlinkVehicle drone(VehicleKind::kHexarotor, AutopilotFlavour::kPx4);
  EXPECT_EQ(drone.command(MAV_CMD_REQUEST_MESSAGE, {MAVLINK_MSG_ID_AUTOPILOT_VERSION}).result,
            CommandResult::kAccepted);
  EXPECT_NE(drone.newest(MAVLINK_MSG_ID_AUTOPILOT_VERSION), nullptr);
  EXPECT_EQ(drone.command(MAV_CMD_REQUEST_PROTOCOL_VERSION, {1}).result, CommandResult::kAccepted);
  EXPECT_NE(drone.newest(MAVLINK_MSG_ID_PROTOCOL_VERSION), nullptr);
  EXPECT_EQ(drone.command(MAV_CMD_GET_HOME_POSITION).result, CommandResult::kAccepted);
  EXPECT_NE(drone.newest(MAVLINK_MSG_ID_HOME_POSITION), nullptr);
  mavlink_timesync_t question{};
  question.ts1 = 77;
  drone.send(pack(question, FlownMavlinkVehicle::kSelf));
  drone.run(0.1);
  ASSERT_NE(drone.newest(MAVLINK_MSG_ID_TIMESYNC), nullptr);
  EXPECT_EQ(unpack<mavlink_timesync_t>(*drone.newest(MAVLINK_MSG_ID_TIMESYNC)).ts1, 77);
}

TEST(MavlinkVehicle, LeavesMessagesForOthersAlone) {
  FlownMavlinkVehicle drone(VehicleKind::kQuadrotor, AutopilotFlavour::kPx4);
  mavlink_set_mode_t mode{};
  mode.target_system = 2;
  mode.base_mode = MAV_MODE_FLAG_CUSTOM_MODE_ENABLED;
  Message message = pack(mode, FlownMavlinkVehicle::kSelf);
  EXPECT_FALSE(drone.vehicle.handle(message, {drone.now, std::nullopt}));
  mavlink_command_long_t command{};
  command.target_system = 2;
  command.command = MAV_CMD_COMPONENT_ARM_DISARM;
  command.param1 = 1.0F;
  EXPECT_FALSE(
      drone.vehicle.handle(pack(command, FlownMavlinkVehicle::kSelf), {drone.now, std::nullopt}));
  EXPECT_FALSE(drone.vehicle.autopilot().is_armed());
}

TEST(MavlinkVehicle, AGroundStationThatBeatsByTheWallIsNotLost) {
  FlownMavlinkVehicle drone(VehicleKind::kQuadrotor, AutopilotFlavour::kPx4);
  mavlink_heartbeat_t beat{};
  beat.type = MAV_TYPE_GCS;
  const Message message = pack(beat, FlownMavlinkVehicle::kSelf);
  drone.vehicle.handle(message, {drone.now, SimTime::from_seconds(1.0)});
  // A simulation 50 times as fast as the wall.
  drone.vehicle.update({drone.now + SimTime::from_seconds(50.0), SimTime::from_seconds(2.0)});
  drone.now = drone.now + SimTime::from_seconds(50.0);
  drone.state.position_stamp = drone.now;
  drone.vehicle.step(drone.now, drone.state);
  EXPECT_FALSE(drone.has_text("ground station"));
}

TEST(MavlinkVehicle, SetPointsThatComeByTheWallAreNotLost) {
  FlownMavlinkVehicle drone(VehicleKind::kQuadrotor, AutopilotFlavour::kPx4);
  mavlink_set_position_target_local_ned_t target{};
  target.target_system = 1;
  target.coordinate_frame = MAV_FRAME_LOCAL_NED;
  target.type_mask = 0xDF8;
  target.z = -3.0F;
  constexpr double kFaster = 20.0, kStep_s = 0.02;
  double wall_s = 0.0;
  const auto advance = [&](double time_s, bool is_sent) {
    for (int i = 0; i < static_cast<int>(time_s / kStep_s); ++i) {
      drone.step();
      wall_s += kStep_s / kFaster;
      const BothTimes now{drone.now, SimTime::from_seconds(wall_s)};
      // Each 0.1 s of the wall, which are 2 s of the world.
      if (is_sent && i % 100 == 0) {
        drone.vehicle.handle(pack(target, FlownMavlinkVehicle::kSelf), now);
      }
      drone.vehicle.update(now);
    }
  };
  advance(6.0, true);
  EXPECT_EQ(drone.command(MAV_CMD_DO_SET_MODE, {1, 6}).result, CommandResult::kAccepted);
  EXPECT_EQ(drone.command(MAV_CMD_COMPONENT_ARM_DISARM, {1}).result, CommandResult::kAccepted);
  advance(20.0, true);
  EXPECT_EQ(drone.vehicle.autopilot().mode(), Mode::kOffboard);
  EXPECT_NEAR(drone.state.p_world_m.z(), 3.0, 0.1);
  advance(1.2 * kFaster, false);  // it has not landed yet
  EXPECT_EQ(drone.vehicle.autopilot().mode(), Mode::kReturn);
}

}  // namespace
}  // namespace trident::bridges::mavlink
