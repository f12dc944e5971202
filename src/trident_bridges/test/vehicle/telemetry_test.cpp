// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/vehicle/telemetry.h"

#include <gtest/gtest.h>

#include <cmath>

#include "trident_base/angle.h"
#include "trident_bridges/mavlink/dialect.h"
#include "vehicle/ground_station.h"

namespace trident::bridges::mavlink {
namespace {

using testing::FlownMavlinkVehicle;
using testing::kNan;
using testing::kOrigin;

VehicleReadings with_imu() {
  VehicleReadings readings;
  readings.imu = ImuReading{SimTime{2'000'000}, {1.0, 2.0, 9.80665}, {0.1, 0.2, 0.3}};
  return readings;
}

TEST(Telemetry, WithoutASensorNothingIsSaidInItsName) {
  FlownMavlinkVehicle drone(VehicleKind::kQuadrotor, AutopilotFlavour::kPx4);
  drone.run(2.0);
  for (const std::uint32_t id : {MAVLINK_MSG_ID_HIGHRES_IMU, MAVLINK_MSG_ID_SCALED_IMU2,
                                 MAVLINK_MSG_ID_VIBRATION, MAVLINK_MSG_ID_WIND_COV}) {
    EXPECT_EQ(drone.newest(id), nullptr) << id;
  }
}

TEST(Telemetry, AnImuSpeaksForwardRightDown) {
  FlownMavlinkVehicle drone(VehicleKind::kQuadrotor, AutopilotFlavour::kPx4);
  drone.vehicle.set_readings(with_imu());
  drone.run(1.1);
  const auto fine = unpack<mavlink_highres_imu_t>(*drone.newest(MAVLINK_MSG_ID_HIGHRES_IMU));
  EXPECT_FLOAT_EQ(fine.xacc, 1.0F);
  EXPECT_FLOAT_EQ(fine.yacc, -2.0F);
  EXPECT_FLOAT_EQ(fine.zacc, -9.80665F);
  EXPECT_FLOAT_EQ(fine.zgyro, -0.3F);
  EXPECT_EQ(fine.time_usec, 2'000U);
  EXPECT_EQ(fine.fields_updated, 0x3F);
  const auto coarse = unpack<mavlink_scaled_imu2_t>(*drone.newest(MAVLINK_MSG_ID_SCALED_IMU2));
  EXPECT_EQ(coarse.zacc, -1000);
  EXPECT_EQ(coarse.ygyro, -200);
}

TEST(Telemetry, AReceiverSaysWhatItSeesAndNoMore) {
  FlownMavlinkVehicle drone(VehicleKind::kQuadrotor, AutopilotFlavour::kPx4);
  VehicleReadings readings;
  readings.gnss = GnssReading{};
  drone.vehicle.set_readings(readings);
  drone.run(0.5);
  auto raw = unpack<mavlink_gps_raw_int_t>(*drone.newest(MAVLINK_MSG_ID_GPS_RAW_INT));
  EXPECT_EQ(raw.fix_type, GPS_FIX_TYPE_NO_FIX);
  EXPECT_EQ(raw.satellites_visible, 255);
  EXPECT_EQ(raw.lat, 0);
  readings.gnss->has_fix = readings.gnss->is_rtk_fixed = true;
  readings.gnss->place = {47.5, 8.25, 430.0};
  readings.gnss->satellites = 17;
  readings.gnss->horizontal_stddev_m = 0.012;
  drone.vehicle.set_readings(readings);
  drone.run(0.5);
  raw = unpack<mavlink_gps_raw_int_t>(*drone.newest(MAVLINK_MSG_ID_GPS_RAW_INT));
  EXPECT_EQ(raw.fix_type, GPS_FIX_TYPE_RTK_FIXED);
  EXPECT_EQ(raw.satellites_visible, 17);
  EXPECT_EQ(raw.lat, 475000000);
  EXPECT_EQ(raw.lon, 82500000);
  EXPECT_EQ(raw.alt, 430000);
  EXPECT_EQ(raw.h_acc, 12U);
}

TEST(Telemetry, WindGoesWhereTheAirGoes) {
  FlownMavlinkVehicle boat(VehicleKind::kBoat, AutopilotFlavour::kArdupilot);
  VehicleReadings readings;
  readings.wind_world_m_s = Eigen::Vector3d(3.0, -4.0, 0.0);
  boat.vehicle.set_readings(readings);
  boat.run(1.1);
  const auto wind = unpack<mavlink_wind_cov_t>(*boat.newest(MAVLINK_MSG_ID_WIND_COV));
  EXPECT_FLOAT_EQ(wind.wind_x, -4.0F);
  EXPECT_FLOAT_EQ(wind.wind_y, 3.0F);
}

TEST(Telemetry, OdometryIsInTheWorldAndInTheBody) {
  FlownMavlinkVehicle drone(VehicleKind::kQuadrotor, AutopilotFlavour::kPx4);
  drone.state.p_world_m = {3.0, 4.0, 0.0};
  drone.state.R_world_body = Eigen::AngleAxisd(0.5 * kPi, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(drone.command(MAV_CMD_SET_MESSAGE_INTERVAL, {MAVLINK_MSG_ID_ODOMETRY, 1e5}).result,
            CommandResult::kAccepted);
  drone.run(0.5);
  const auto odometry = unpack<mavlink_odometry_t>(*drone.newest(MAVLINK_MSG_ID_ODOMETRY));
  EXPECT_FLOAT_EQ(odometry.x, 4.0F);
  EXPECT_FLOAT_EQ(odometry.y, 3.0F);
  EXPECT_NEAR(std::abs(odometry.q[0]), 1.0, 1e-6) << "it heads north";
  EXPECT_EQ(odometry.frame_id, MAV_FRAME_LOCAL_NED);
  EXPECT_EQ(odometry.child_frame_id, MAV_FRAME_BODY_FRD);
  EXPECT_TRUE(std::isnan(odometry.pose_covariance[0]));
}

TEST(Telemetry, WhereItGoesIsSaidWhileItGoes) {
  FlownMavlinkVehicle drone(VehicleKind::kQuadrotor, AutopilotFlavour::kPx4);
  EXPECT_EQ(drone.newest(MAVLINK_MSG_ID_NAV_CONTROLLER_OUTPUT), nullptr);
  drone.command(MAV_CMD_COMPONENT_ARM_DISARM, {1});
  drone.command(MAV_CMD_NAV_TAKEOFF, {0, 0, 0, kNan, kNan, kNan, kOrigin.altitude_m + 5});
  drone.run_until([&] { return drone.state.p_world_m.z() > 4.95; }, 30.0);
  const GeoPlace east = GeoFrame(kOrigin).to_geo({100.0, 0.0, 5.0});
  drone.command(MAV_CMD_DO_REPOSITION,
                {-1, 0, 0, kNan, east.latitude_deg, east.longitude_deg, east.altitude_m});
  drone.run(4.0);
  const auto target = unpack<mavlink_position_target_local_ned_t>(
      *drone.newest(MAVLINK_MSG_ID_POSITION_TARGET_LOCAL_NED));
  EXPECT_EQ(target.type_mask, 0);
  EXPECT_GT(target.y, 1.0F);
  EXPECT_GT(target.vy, 1.0F);
  EXPECT_NEAR(target.z, -5.0, 0.1);
  EXPECT_NE(drone.newest(MAVLINK_MSG_ID_NAV_CONTROLLER_OUTPUT), nullptr);
}

TEST(Telemetry, ABrokenFenceIsNoHealthyOne) {
  FlownMavlinkVehicle drone(VehicleKind::kQuadrotor, AutopilotFlavour::kPx4);
  drone.run(1.1);
  const auto status = [&] {
    return unpack<mavlink_sys_status_t>(*drone.newest(MAVLINK_MSG_ID_SYS_STATUS));
  };
  EXPECT_NE(status().onboard_control_sensors_present & MAV_SYS_STATUS_GEOFENCE, 0U);
  EXPECT_NE(status().onboard_control_sensors_health & MAV_SYS_STATUS_GEOFENCE, 0U);
}

TEST(Telemetry, VibrationIsWhatIsAboveTheFloor) {
  VibrationMeter still, shaken;
  for (int i = 0; i < 1000; ++i) {
    ImuReading reading;
    reading.stamp = SimTime{i * 5'000'000LL};
    reading.f_body_m_s2 = {0.0, 0.0, 9.8};
    still.add(reading);
    reading.f_body_m_s2.x() = i % 2 == 0 ? 3.0 : -3.0;
    shaken.add(reading);
  }
  EXPECT_LT(still.level_m_s2().norm(), 1e-9);
  EXPECT_NEAR(shaken.level_m_s2().x(), 3.0, 0.5);
  EXPECT_LT(shaken.level_m_s2().z(), 1e-9);
}

}  // namespace
}  // namespace trident::bridges::mavlink
