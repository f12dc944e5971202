// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "mavlink/packets.h"
#include "vehicle/ground_station.h"

namespace trident::bridges::mavlink {
namespace {

TEST(RandomMessages, LeaveAVehicleThatStillAnswers) {
  for (const auto flavour : {AutopilotFlavour::kPx4, AutopilotFlavour::kArdupilot}) {
    testing::FlownMavlinkVehicle drone(VehicleKind::kQuadrotor, flavour);
    for (std::uint32_t i = 0; i < 20'000; ++i) {
      Message message = testing::random_message(i, i);
      message.source = {static_cast<std::uint8_t>(i % 7 + 2), 1};
      drone.vehicle.handle(message, {drone.now, std::nullopt});
      if (i % 10 == 0) drone.step();
      drone.texts.clear();
      drone.answers.clear();
    }
    drone.run(10.0);  // what was begun ends
    EXPECT_EQ(drone.command(519, {1}).result, CommandResult::kAccepted);
  }
}

}  // namespace
}  // namespace trident::bridges::mavlink
