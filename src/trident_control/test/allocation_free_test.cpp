// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <new>

#include "allocation_count.h"
#include "trident_control/lee_position_controller.h"
#include "trident_control/roll_pitch_yawrate_thrust_controller.h"
#include "trident_control/setpoint_queue.h"
#include "trident_control/vessel_controller.h"

namespace trident::control {
namespace {

TEST(AllocationFree, the_counter_counts) {
  EXPECT_EQ(allocations_of([] { ::operator delete(::operator new(8)); }), 1u);
}

TEST(AllocationFree, controllers) {
  const LeePositionController lee{LeeParams{}};
  const RollPitchYawrateThrustController attitude{RollPitchYawrateThrustParams{}};
  std::array<double, 6> speeds;
  int ok = 0;
  EXPECT_EQ(allocations_of([&] {
              for (int i = 0; i < 1000; ++i) {
                ok += lee.compute({}, {}, speeds) == ControlStatus::ok;
                ok += attitude.compute({}, {0.1, 0.1, 0.1, 15.0}, speeds) == ControlStatus::ok;
              }
            }),
            0u);
  EXPECT_EQ(ok, 2000);
}

TEST(AllocationFree, streamed_set_points) {
  SetpointQueue queue;
  std::array<TimedSetpoint, 5> points;
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i].time_from_start = {static_cast<long>(i) * 10'000'000};
  EXPECT_EQ(allocations_of([&] {
              for (long k = 1; k < 10000; ++k) {
                if (k % 5 == 1) queue.push({k * 10'000'000}, points);
                queue.advance({k * 10'000'000});
              }
            }),
            0u);
}

ThrusterParams thruster(double x, double y, double yaw, double max_angle) {
  ThrusterParams params;
  params.name = "thruster";
  params.position = {x, y, 0.0};
  params.yaw = yaw;
  params.max_angle = max_angle;
  return params;
}

TEST(AllocationFree, vessels_on_a_path_and_at_a_station) {
  VesselModel model;
  model.mass = {180.0, 180.0, 446.0};
  model.linear_damping = {50.0, 40.0, 400.0};
  model.thrusters = {thruster(-2.4, 1.0, 0.0, 1.57), thruster(-2.4, -1.0, 0.0, 1.57),
                     thruster(1.6, 0.7, -0.785, 0.0), thruster(1.6, -0.7, 0.785, 0.0)};
  VesselController controller(model, {});
  VesselCommand path, station;
  path.kind = VesselCommand::Kind::kPath;
  path.waypoints = {{0.0, 0.0}, {100.0, 0.0}};
  station.kind = VesselCommand::Kind::kStation;
  station.waypoints = {{1.0, 2.0}};
  for (const VesselCommand& command : {path, station}) {
    controller.push({}, command);
    OdometryState state;
    std::int64_t time = controller.mode() == VesselMode::kIdle ? 0 : 10'000'000'000;
    controller.update({time}, state);
    EXPECT_EQ(allocations_of([&] {
                for (int i = 0; i < 500; ++i) {
                  state.p_world_body.x() += 0.01;
                  controller.update({time += 10'000'000}, state);
                }
              }),
              0u);
  }
  EXPECT_EQ(controller.mode(), VesselMode::kStation);
}

}  // namespace
}  // namespace trident::control
