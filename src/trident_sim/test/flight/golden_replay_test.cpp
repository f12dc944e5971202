// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "golden_data.h"
#include "golden_world.h"

namespace trident::sim {
namespace {

/// Six recorded flights in which no answer came late.
class GoldenReplay : public testing::TestWithParam<int> {};

/// The recorded answers, replayed with their stamps and no controller. Without feedback small
/// differences grow, so not for ever.
TEST_P(GoldenReplay, RecordedCommandsLeadToTheRecordedMotion) {
  TRIDENT_NEEDS_GOLDEN();
  constexpr double kDt = 0.01, kUntil_s = 8.0;
  const std::string name = "UAV" + std::to_string(GetParam());
  const std::string folder = golden_folder() + "/six_firefly_dt0.01_nodelay_rep1/";
  const auto flight = read_flight(folder + "hover_" + name + ".csv", kDt);
  const auto commands = read_commands(folder + "motor_commands_" + name + ".csv");
  GoldenWorld world(golden_folder() + "/params/basic.world");
  Model& firefly = world.add_firefly(name,
                                     at(std::round(flight.front().T_world_base.p.x()),
                                        std::round(flight.front().T_world_base.p.y()), 0.08),
                                     false);
  auto* in = world->ports().find_in<ActuatorCommand>(name + "/command/motor_speed");
  std::size_t next = 0;
  Deviation deviation;
  for (const FlightRow& row : flight) {
    if (row.t_s > kUntil_s) break;
    for (; world->step_count() < row.step; world->step()) {
      for (; next < commands.size() && commands[next].stamp <= world->time(); ++next) {
        ActuatorCommand command;
        command.stamp = commands[next].stamp;
        command.angular_velocities.assign({commands[next].rotor_rad_s.data(), 6});
        in->write(command);
      }
    }
    deviation.add(firefly.T_world_model(), row.T_world_base);
  }
  EXPECT_GT(firefly.T_world_model().p.z(), 1.0);
  EXPECT_LT(deviation.position_m, 0.002);
  EXPECT_LT(deviation.angle_deg, 0.3);
}
INSTANTIATE_TEST_SUITE_P(Vehicles, GoldenReplay, testing::Range(1, 7));

}  // namespace
}  // namespace trident::sim
