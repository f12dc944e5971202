// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/conversions.h"
#include "core/mavros_params.h"
#include "core/mode_names.h"
#include "core/packet_topics.h"
#include "core/plugin.h"
#include "core/setpoints.h"
#include "core/waypoints.h"
#include "trident_base/error.h"
#include "trident_bridges/mavlink/packet_writer.h"

namespace trident::mavros {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(MavrosConversions, AWholeNumberIsTheNearestThatAFieldHolds) {
  EXPECT_EQ(to_whole<std::int16_t>(-2.6), -3);
  EXPECT_EQ(to_whole<std::uint16_t>(-1.0), 0);
  EXPECT_EQ(to_whole<std::uint16_t>(1e300), 65535);
  EXPECT_EQ(to_whole<std::int32_t>(-std::numeric_limits<double>::infinity()), INT32_MIN);
  EXPECT_EQ(to_whole<std::int32_t>(std::numeric_limits<double>::quiet_NaN()), 0);
}

TEST(ModeNames, AreThoseOfTheVehicleAndComeBack) {
  EXPECT_EQ(mode_name(MAV_AUTOPILOT_PX4, MAV_TYPE_QUADROTOR, 6U << 16), "OFFBOARD");
  EXPECT_EQ(mode_name(MAV_AUTOPILOT_PX4, MAV_TYPE_QUADROTOR, 4U << 16 | 4U << 24), "AUTO.MISSION");
  EXPECT_EQ(mode_name(MAV_AUTOPILOT_ARDUPILOTMEGA, MAV_TYPE_QUADROTOR, 4), "GUIDED");
  EXPECT_EQ(mode_name(MAV_AUTOPILOT_ARDUPILOTMEGA, MAV_TYPE_SURFACE_BOAT, 4), "HOLD");
  EXPECT_EQ(mode_name(MAV_AUTOPILOT_ARDUPILOTMEGA, MAV_TYPE_FIXED_WING, 4), "ACRO");
  EXPECT_EQ(mode_name(MAV_AUTOPILOT_GENERIC, MAV_TYPE_QUADROTOR, 9), "CMODE(9)");
  EXPECT_EQ(mode_number(MAV_AUTOPILOT_PX4, MAV_TYPE_QUADROTOR, "AUTO.RTL"), 4U << 16 | 5U << 24);
  EXPECT_EQ(mode_number(MAV_AUTOPILOT_ARDUPILOTMEGA, MAV_TYPE_GROUND_ROVER, "HOLD"), 4U);
  EXPECT_EQ(mode_number(MAV_AUTOPILOT_ARDUPILOTMEGA, MAV_TYPE_QUADROTOR, "21"), 21U);
  EXPECT_EQ(mode_number(MAV_AUTOPILOT_ARDUPILOTMEGA, MAV_TYPE_QUADROTOR, "HOLD"), std::nullopt);
}

TEST(Setpoints, EnuBecomesNedAndYawTurnsTheOtherDirectionFromNorth) {
  LocalTarget target = position_target(MAV_FRAME_LOCAL_NED);
  target.p_m = {1.0, 2.0, 3.0};
  target.yaw = 0.0;  // east
  const auto payload = local_payload(target, 7);
  EXPECT_EQ(payload.time_boot_ms, 7U);
  EXPECT_EQ(payload.type_mask, 0b100111111000);
  EXPECT_FLOAT_EQ(payload.x, 2.0F);
  EXPECT_FLOAT_EQ(payload.y, 1.0F);
  EXPECT_FLOAT_EQ(payload.z, -3.0F);
  EXPECT_NEAR(payload.yaw, kPi / 2, 1e-6);
}

TEST(Setpoints, InBodyFramesFluBecomesFrd) {
  LocalTarget target = velocity_target(MAV_FRAME_BODY_NED);
  target.v_m_s = {1.0, 2.0, 3.0};
  target.yaw = 0.5;
  target.yaw_rate_rad_s = 0.25;
  const auto payload = local_payload(target, 0);
  EXPECT_EQ(payload.type_mask, 0b010111000111);
  EXPECT_FLOAT_EQ(payload.vx, 1.0F);
  EXPECT_FLOAT_EQ(payload.vy, -2.0F);
  EXPECT_FLOAT_EQ(payload.vz, -3.0F);
  EXPECT_FLOAT_EQ(payload.yaw, -0.5F);
  EXPECT_FLOAT_EQ(payload.yaw_rate, -0.25F);
}

TEST(Setpoints, AForceHasItsBit) {
  EXPECT_EQ(acceleration_target(false).mask, 0b110000111111);
  EXPECT_EQ(acceleration_target(true).mask, 0b111000111111);
}

TEST(Setpoints, WhatTheVehicleFollowsIsTheReverse) {
  LocalTarget target = position_target(MAV_FRAME_LOCAL_NED);
  target.p_m = {1.0, -2.0, 3.0};
  target.yaw = 0.75;
  const auto sent = local_payload(target, 0);
  mavlink_position_target_local_ned_t said{};
  said.coordinate_frame = sent.coordinate_frame;
  said.type_mask = sent.type_mask;
  said.x = sent.x;
  said.y = sent.y;
  said.z = sent.z;
  said.yaw = sent.yaw;
  EXPECT_NEAR((local_target(said).p_m - target.p_m).norm(), 0.0, 1e-6);
  EXPECT_NEAR(local_target(said).yaw, 0.75, 1e-6);
}

TEST(Setpoints, AttitudeAndRatesBecomeThoseOfFrdInNed) {
  AttitudeSetpoint target;
  target.R_world_body = Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitZ());  // north
  target.w_body_rad_s = {0.1, 0.2, 0.3};
  target.thrust = 0.5;
  const auto payload = attitude_payload(target, 0);
  EXPECT_NEAR(std::abs(payload.q[0]), 1.0, 1e-6);  // level, heading north: the identity
  EXPECT_FLOAT_EQ(payload.body_roll_rate, 0.1F);
  EXPECT_FLOAT_EQ(payload.body_pitch_rate, -0.2F);
  EXPECT_FLOAT_EQ(payload.body_yaw_rate, -0.3F);
}

TEST(Setpoints, WhatCountsMustBeANumberAndOnTheEarth) {
  LocalTarget local = position_target(MAV_FRAME_LOCAL_NED);
  local.v_m_s.x() = kNan;  // ignored
  EXPECT_EQ(problem_of(local), "");
  local.p_m.y() = kNan;
  EXPECT_EQ(problem_of(local), "position is not finite");
  local = position_target(3);
  EXPECT_EQ(problem_of(local), "coordinate_frame is 3, legal: 1, 7, 8, 9, 12");
  GlobalTarget global;
  global.latitude_deg = 91.0;
  EXPECT_EQ(problem_of(global), "latitude is 91, legal: -90 to 90");
  AttitudeSetpoint attitude;
  attitude.thrust = 1.5;
  EXPECT_EQ(problem_of(attitude), "thrust is 1.5, legal: -1 to 1");
  EXPECT_THROW(frame_of_name("BODY"), Error);
}

TEST(Waypoints, ComeBackAsTheyWere) {
  mavros_msgs::Waypoint waypoint;
  for (const std::uint8_t frame : {0, 1, 2, 3, 6}) {
    waypoint.frame = frame;
    waypoint.command = 16;
    waypoint.is_current = 1U;
    waypoint.param4 = 1.5F;
    waypoint.x_lat = frame == 2 ? 12.0 : -47.1234567;
    waypoint.y_long = frame == 1 ? -8.5 : 8.0;
    waypoint.z_alt = 12.5;
    const auto back = to_waypoint(to_item(waypoint));
    EXPECT_EQ(back.frame, frame);
    EXPECT_NEAR(back.x_lat, waypoint.x_lat, frame == 1 ? 1e-4 : 1e-7) << int{frame};
    EXPECT_DOUBLE_EQ(back.y_long, waypoint.y_long);
    EXPECT_EQ(back.param4, 1.5F);
    EXPECT_EQ(back.z_alt, 12.5);
  }
  EXPECT_EQ(to_item(waypoint).x, -471234567);
}

TEST(Waypoints, APlaceThatIsNotOnEarthHasAProblem) {
  mavros_msgs::Waypoint waypoint;
  waypoint.command = MAV_CMD_NAV_WAYPOINT;
  waypoint.frame = MAV_FRAME_GLOBAL_RELATIVE_ALT;
  waypoint.x_lat = 63.4;
  waypoint.y_long = 181.0;
  EXPECT_EQ(problem_of(waypoint), "y_long is 181, legal: +-180");
  waypoint.y_long = 10.4;
  EXPECT_EQ(problem_of(waypoint), "");
  waypoint.x_lat = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(problem_of(waypoint), "x_lat is nan, legal: +-90");
  waypoint.command = MAV_CMD_DO_CHANGE_SPEED;
  EXPECT_EQ(problem_of(waypoint), "");
}

TEST(Packets, ComeBackByteForByte) {
  ros::Time::init();
  mavlink_heartbeat_t beat{};
  beat.custom_mode = 0x01020304;
  beat.type = MAV_TYPE_QUADROTOR;
  beat.mavlink_version = 3;
  bridges::mavlink::PacketWriter writer;
  const auto bytes = writer.write(bridges::mavlink::pack(beat, {1, 1}));
  bridges::mavlink::PacketParser parser;
  parser.feed_datagram(bytes);
  const auto packet = parser.next();
  ASSERT_TRUE(packet);
  mavros_msgs::Mavlink message;
  message.payload64 = {1, 2, 3};  // of a longer packet that was here before
  message.signature = {4};
  to_ros(*packet, message);
  EXPECT_EQ(message.len, 9);
  EXPECT_EQ(message.payload64.size(), 2U);
  EXPECT_EQ(message.payload64[0] & 0xFFFFFFFFU, 0x01020304U);
  std::vector<std::uint8_t> back{5};
  to_packet(message, back);
  EXPECT_EQ(back, std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
}

TEST(Packets, AMessageThatIsNoPacketIsEmpty) {
  mavros_msgs::Mavlink message;
  std::vector<std::uint8_t> packet{5};
  to_packet(message, packet);
  EXPECT_TRUE(packet.empty());
  message.magic = mavros_msgs::Mavlink::MAVLINK_V20;
  message.len = 9;  // and no payload
  packet = {5};
  to_packet(message, packet);
  EXPECT_TRUE(packet.empty());
}

TEST(PluginLists, ABlacklistedPluginIsNotLoadedUnlessItIsWhitelisted) {
  MavrosParams params;
  params.plugin_blacklist = {"*"};
  params.plugin_whitelist = {"sys_*", "imu"};
  EXPECT_TRUE(is_wanted("sys_status", params));
  EXPECT_TRUE(is_wanted("imu", params));
  EXPECT_FALSE(is_wanted("waypoint", params));
  EXPECT_TRUE(fits_glob("setpoint_raw", "setpoint_?aw"));
}

TEST(Conversions, TheTriangleOfACovarianceComesBack) {
  bridges::mavlink::Matrix6 matrix;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) matrix(i, j) = (i + 1) * (j + 1);
  }
  std::array<float, 21> field{};
  to_upper_triangle(matrix, field);
  EXPECT_EQ(field[1], 2.0F);
  EXPECT_EQ(from_upper_triangle(field), matrix);
  field[0] = static_cast<float>(kNan);
  EXPECT_TRUE(from_upper_triangle(field).isZero());
}

TEST(Conversions, EulerAnglesComeBack) {
  const Eigen::Vector3d angles = to_euler(from_euler(0.1, -0.2, 2.5));
  EXPECT_NEAR((angles - Eigen::Vector3d(0.1, -0.2, 2.5)).norm(), 0.0, 1e-12);
  EXPECT_EQ(to_rotation(geometry_msgs::Quaternion()).w(), 1.0);
}

}  // namespace
}  // namespace trident::mavros
