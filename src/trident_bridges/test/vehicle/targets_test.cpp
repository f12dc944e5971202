// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/vehicle/targets.h"

#include <gtest/gtest.h>

#include <cmath>

#include "trident_base/angle.h"
#include "trident_bridges/mavlink/dialect.h"

namespace trident::bridges::mavlink {
namespace {

constexpr Address kSelf{1, 1}, kCompanion{1, 191};
constexpr unsigned kPlaceAlone = 0xFFF & ~7U, kVelocityAlone = 0xFFF & ~(7U << 3);

class Targets : public ::testing::Test {
 protected:
  ReceivedTarget read(std::uint8_t frame, unsigned mask) {
    payload_.target_system = 1;
    payload_.coordinate_frame = frame;
    payload_.type_mask = static_cast<std::uint16_t>(mask);
    return *read_target(pack(payload_, kCompanion), kSelf, context_);
  }

  GeoFrame geo_{{47.4, 8.5, 400.0}};
  /// The vehicle looks north.
  PlaceContext context_{geo_, {0, 0, 0}, {10, 20, 5}, 0.5 * kPi};
  mavlink_set_position_target_local_ned_t payload_{};
};

TEST_F(Targets, PlacesOfEachLocalFrameAreWhereTheyBelong) {
  payload_.x = 1.0F;
  payload_.y = 2.0F;
  payload_.z = -3.0F;
  EXPECT_LT((*read(MAV_FRAME_LOCAL_NED, kPlaceAlone).target.p_m - Eigen::Vector3d(2, 1, 3)).norm(),
            1e-6);
  EXPECT_LT((*read(MAV_FRAME_LOCAL_OFFSET_NED, kPlaceAlone).target.p_m - Eigen::Vector3d(12, 21, 8))
                .norm(),
            1e-6);
  // Looking north: forward is north, right is east.
  EXPECT_LT((*read(MAV_FRAME_BODY_OFFSET_NED, kPlaceAlone).target.p_m - Eigen::Vector3d(12, 21, 8))
                .norm(),
            1e-6);
  context_.yaw = 0.0;
  // Looking east: forward is east, right is south.
  EXPECT_LT((*read(MAV_FRAME_BODY_NED, kPlaceAlone).target.p_m - Eigen::Vector3d(11, 18, 8)).norm(),
            1e-6);
}

TEST_F(Targets, VelocityAndHeadingTurnWithABodyFrame) {
  payload_.vx = 2.0F;
  payload_.yaw = 0.3F;
  const ReceivedTarget body = read(MAV_FRAME_BODY_NED, kVelocityAlone & ~1024U);
  EXPECT_FALSE(body.target.p_m);
  EXPECT_LT((*body.target.v_m_s - Eigen::Vector3d(0, 2, 0)).norm(), 1e-6);
  EXPECT_NEAR(*body.target.yaw, 0.5 * kPi - 0.3, 1e-6);
  const ReceivedTarget world = read(MAV_FRAME_LOCAL_NED, kVelocityAlone & ~1024U);
  EXPECT_LT((*world.target.v_m_s - Eigen::Vector3d(0, 2, 0)).norm(), 1e-6);
  EXPECT_NEAR(*world.target.yaw, 0.5 * kPi - 0.3, 1e-6);
}

TEST_F(Targets, MasksThatMeanNothingAreRefusedWithTheirNumber) {
  EXPECT_NE(read(MAV_FRAME_LOCAL_NED, kPlaceAlone | 1U).problem.find("axes of position"),
            std::string::npos);
  EXPECT_NE(read(MAV_FRAME_LOCAL_NED, 0xFFF).problem.find("4095 ignores everything"),
            std::string::npos);
  EXPECT_NE(read(MAV_FRAME_LOCAL_NED, 512).problem.find("forces"), std::string::npos);
  EXPECT_NE(read(MAV_FRAME_GLOBAL, kPlaceAlone).problem.find("frame 0"), std::string::npos);
}

TEST_F(Targets, StampsAreTheSendersWhereItHasAClock) {
  EXPECT_FALSE(read(MAV_FRAME_LOCAL_NED, kPlaceAlone).stamp);
  payload_.time_boot_ms = 1500;
  EXPECT_EQ(read(MAV_FRAME_LOCAL_NED, kPlaceAlone).stamp->ns, 1'500'000'000);
}

TEST_F(Targets, GlobalPlacesCountFromSeaOrHome) {
  mavlink_set_position_target_global_int_t payload{};
  payload.target_system = 1;
  payload.type_mask = kPlaceAlone;
  payload.lat_int = 474'000'000;
  payload.lon_int = 85'000'000;
  payload.coordinate_frame = MAV_FRAME_GLOBAL_INT;
  payload.alt = 410.0F;
  context_.home_m.z() = 2.0;
  EXPECT_LT((*read_target(pack(payload, kCompanion), kSelf, context_)->target.p_m -
             Eigen::Vector3d(0, 0, 10))
                .norm(),
            1e-4);
  payload.coordinate_frame = MAV_FRAME_GLOBAL_RELATIVE_ALT_INT;
  payload.alt = 10.0F;
  EXPECT_LT((*read_target(pack(payload, kCompanion), kSelf, context_)->target.p_m -
             Eigen::Vector3d(0, 0, 12))
                .norm(),
            1e-4);
  payload.target_system = 2;
  EXPECT_FALSE(read_target(pack(payload, kCompanion), kSelf, context_));
}

TEST_F(Targets, AttitudesAreTurnedIntoTheWorldAndNeedAThrust) {
  mavlink_set_attitude_target_t payload{};
  payload.target_system = 1;
  payload.type_mask = 3;  // attitude, yaw rate, thrust
  payload.q[0] = 1.0F;    // level, to the north
  payload.body_yaw_rate = 0.5F;
  payload.thrust = 0.6F;
  ReceivedTarget received = *read_target(pack(payload, kCompanion), kSelf, context_);
  ASSERT_TRUE(received.problem.empty()) << received.problem;
  const Eigen::Vector3d forward = *received.target.R_world_body * Eigen::Vector3d::UnitX();
  EXPECT_LT((forward - Eigen::Vector3d::UnitY()).norm(), 1e-6);
  EXPECT_NEAR(*received.target.yaw_rate, -0.5, 1e-6);
  EXPECT_NEAR(*received.target.thrust, 0.6, 1e-6);
  payload.type_mask = 67;
  received = *read_target(pack(payload, kCompanion), kSelf, context_);
  EXPECT_NE(received.problem.find("need a thrust"), std::string::npos);
  payload.type_mask = 128;
  payload.body_roll_rate = 0.2F;
  payload.body_pitch_rate = 0.1F;
  received = *read_target(pack(payload, kCompanion), kSelf, context_);
  EXPECT_LT((*received.target.w_body_rad_s - Eigen::Vector3d(0.2, -0.1, -0.5)).norm(), 1e-6);
}

}  // namespace
}  // namespace trident::bridges::mavlink
