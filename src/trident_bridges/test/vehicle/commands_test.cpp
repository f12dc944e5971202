// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/vehicle/commands.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "trident_base/angle.h"
#include "trident_bridges/mavlink/dialect.h"

namespace trident::bridges::mavlink {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

class Commands : public ::testing::Test {
 protected:
  Interpretation read(std::uint16_t number, std::array<double, 7> params,
                      Flavor flavor = Flavor::kArduPilot) {
    Command command;
    command.command = number;
    command.params = params;
    return interpret(command, flavor, context_);
  }
  template <class Asked>
  Asked request(const Interpretation& interpretation) {
    const auto* const request = std::get_if<Request>(&interpretation);
    EXPECT_NE(request, nullptr) << std::get<CommandReply>(interpretation).reason;
    return std::get<Asked>(*request);
  }
  std::string refusal(const Interpretation& interpretation) {
    const auto* const reply = std::get_if<CommandReply>(&interpretation);
    return reply == nullptr ? "" : reply->reason;
  }

  GeoFrame geo_{{47.4, 8.5, 400.0}};
  PlaceContext context_{geo_, {0, 0, 1}, {10, 20, 5}, 0.0};
};

TEST_F(Commands, AltitudesAreThoseOfTheFlavor) {
  const GeoPlace there = geo_.to_geo({30, 40, 12});
  const std::array<double, 7> above_sea{
      0, 0, 0, kNoNumber, there.latitude_deg, there.longitude_deg, there.altitude_m};
  auto go_to = request<GoToRequest>(read(MAV_CMD_DO_REPOSITION, above_sea, Flavor::kPx4));
  EXPECT_LT((go_to.p_world_m - Eigen::Vector3d(30, 40, 12)).norm(), 1e-6);
  std::array<double, 7> above_home = above_sea;
  above_home[6] = 11.0;
  go_to = request<GoToRequest>(read(MAV_CMD_DO_REPOSITION, above_home));
  EXPECT_LT((go_to.p_world_m - Eigen::Vector3d(30, 40, 12)).norm(), 0.01);
  EXPECT_FALSE(go_to.yaw);
  const auto px4 = request<TakeOffRequest>(
      read(MAV_CMD_NAV_TAKEOFF, {0, 0, 0, kNoNumber, kNoNumber, kNoNumber, 415.0}, Flavor::kPx4));
  EXPECT_NEAR(px4.height_m, 10.0, 0.01) << "it stands at 405 m";
  const auto ardupilot = request<TakeOffRequest>(read(MAV_CMD_NAV_TAKEOFF, {0, 0, 0, 0, 0, 0, 14}));
  EXPECT_NEAR(ardupilot.height_m, 10.0, 1e-9) << "it stands 4 m above home";
  EXPECT_TRUE(std::isnan(
      request<TakeOffRequest>(read(MAV_CMD_NAV_TAKEOFF, {0, 0, 0, 0, 0, 0, kNoNumber})).height_m));
}

TEST_F(Commands, ModesAreNumberedAsTheFlavorDoes) {
  EXPECT_EQ(request<ModeRequest>(read(MAV_CMD_DO_SET_MODE, {1, 4, 0})).custom_mode, 4U);
  EXPECT_EQ(request<ModeRequest>(read(MAV_CMD_DO_SET_MODE, {29, 4, 5}, Flavor::kPx4)).custom_mode,
            4U << 16 | 5U << 24);
  EXPECT_NE(refusal(read(MAV_CMD_DO_SET_MODE, {0, 4, 0})).find("param1 0"), std::string::npos);
  EXPECT_NE(refusal(read(MAV_CMD_DO_SET_MODE, {1, 1e9, 0})).find("param2"), std::string::npos);
}

TEST_F(Commands, HeadingsAreClockwiseFromNorth) {
  const auto south = request<YawRequest>(read(MAV_CMD_CONDITION_YAW, {180, 0, 0, 0}));
  EXPECT_NEAR(south.yaw, -0.5 * kPi, 1e-9);
  EXPECT_FALSE(south.is_relative);
  const auto left = request<YawRequest>(read(MAV_CMD_CONDITION_YAW, {90, 0, -1, 1}));
  EXPECT_NEAR(left.yaw, 0.5 * kPi, 1e-9);
  EXPECT_TRUE(left.is_relative);
}

TEST_F(Commands, ForcedArmingHasItsNumber) {
  EXPECT_FALSE(request<ArmRequest>(read(MAV_CMD_COMPONENT_ARM_DISARM, {1, 1})).is_forced);
  EXPECT_TRUE(request<ArmRequest>(read(MAV_CMD_COMPONENT_ARM_DISARM, {1, 21196})).is_forced);
}

TEST_F(Commands, PlacesThatAreNoneAreRefused) {
  const auto asked = {MAV_CMD_DO_SET_HOME, MAV_CMD_DO_REPOSITION, MAV_CMD_DO_SET_ROI_LOCATION};
  for (const auto number : asked) {
    EXPECT_NE(refusal(read(static_cast<std::uint16_t>(number), {0, 0, 0, 0, 91, 8, 10})), "");
    EXPECT_NE(refusal(read(static_cast<std::uint16_t>(number), {0, 0, 0, 0, 47, 8, kNoNumber})),
              "");
  }
}

TEST_F(Commands, NoParametersCrashAnyCommand) {
  for (int number = 0; number < 3000; ++number) {
    for (const double value : {kNoNumber, 0.0, -1.0, 1.0, 1e30, -1e30}) {
      std::array<double, 7> params{};
      params.fill(value);
      const Interpretation asked = read(static_cast<std::uint16_t>(number), params);
      if (const auto* const reply = std::get_if<CommandReply>(&asked)) {
        EXPECT_TRUE(reply->result == CommandResult::kAccepted || !reply->reason.empty()) << number;
      }
    }
  }
}

TEST_F(Commands, WhoOnlyAsksChangesNothing) {
  mavlink_command_long_t command{};
  for (const int number : {MAV_CMD_SET_MESSAGE_INTERVAL, MAV_CMD_REQUEST_MESSAGE}) {
    command.command = static_cast<std::uint16_t>(number);
    EXPECT_FALSE(changes_behavior(pack(command, {255, 190}))) << number;
  }
  command.command = MAV_CMD_COMPONENT_ARM_DISARM;
  EXPECT_TRUE(changes_behavior(pack(command, {255, 190})));
  EXPECT_FALSE(changes_behavior(pack(mavlink_heartbeat_t{}, {255, 190})));
  EXPECT_FALSE(changes_behavior(pack(mavlink_param_request_list_t{}, {255, 190})));
  EXPECT_FALSE(changes_behavior(pack(mavlink_mission_request_int_t{}, {255, 190})));
  EXPECT_TRUE(changes_behavior(pack(mavlink_param_set_t{}, {255, 190})));
  EXPECT_TRUE(changes_behavior(pack(mavlink_mission_item_int_t{}, {255, 190})));
  EXPECT_TRUE(changes_behavior(pack(mavlink_set_position_target_local_ned_t{}, {255, 190})));
}

}  // namespace
}  // namespace trident::bridges::mavlink
