// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "lee_quad.h"
#include "test_world.h"
#include "trident_control_sim/lee_plugin.h"

namespace trident::sim {
namespace {

/// A quad with its controller, commanded to `p_world`.
class Flight {
 public:
  Flight(const LeeQuad& lee, LoopTiming timing, const Eigen::Vector3d& p_world, double yaw = 0.0)
      : world_(world_spec(), with_timing(timing)) {
    control::register_control_plugins(world_.registry);
    quad_ = &world_.add(lee.model());
    control::TimedSetpoint setpoint;
    setpoint.point.p_world = p_world;
    setpoint.point.yaw = yaw;
    world_->ports()
        .find_in<control::TrajectorySample>("quad/command/trajectory")
        ->write({{0}, {setpoint}});
  }
  World* operator->() { return &*world_; }
  Model& quad() { return *quad_; }

 private:
  TestWorld world_;
  Model* quad_;
};

class ClosedLoop : public testing::TestWithParam<LoopTiming> {};

TEST_P(ClosedLoop, SettlesAtTheOffsetOfTheThrustBalance) {
  for (const double controller_mass : {0.9, 1.0, 1.15}) {
    const LeeQuad lee(controller_mass);
    Flight flight(lee, GetParam(), {0, 0, 2});
    flight->step(1500);
    // RotorS' controller reckons with g = 9.81 and its own mass; the world has 9.8 and the true
    // one.
    const double offset =
        (controller_mass * 9.81 - lee.options.mass_kg() * 9.8) / LeeQuad::kPositionGain;
    EXPECT_TRUE(is_near(flight.quad().T_world_model().p, {0, 0, 2 + offset}, 1e-3));
    EXPECT_LT(flight.quad().bodies[0]->velocity().norm(), 1e-3);
  }
}

TEST_P(ClosedLoop, FliesToThePointAndYaw) {
  Flight flight(LeeQuad(1.0), GetParam(), {1, -0.5, 1}, 1.0);
  flight->step(2000);
  const SE3 T = flight.quad().T_world_model();
  EXPECT_TRUE(is_near(T.p, {1, -0.5, 1.0 + 0.01 / LeeQuad::kPositionGain}, 2e-3));
  EXPECT_NEAR(T.rpy().z(), 1.0, 0.01);
}

TEST_P(ClosedLoop, ResetFliesTheSameAgain) {
  Flight flight(LeeQuad(1.0), GetParam(), {1, -0.5, 1});
  flight->step(300);
  const std::string first = flight->state_hash();
  flight->reset();
  control::TimedSetpoint setpoint;
  setpoint.point.p_world = {1, -0.5, 1};
  flight->ports()
      .find_in<control::TrajectorySample>("quad/command/trajectory")
      ->write({{0}, {setpoint}});
  flight->step(300);
  EXPECT_EQ(flight->state_hash(), first);
}
INSTANTIATE_TEST_SUITE_P(Timing, ClosedLoop,
                         testing::Values(LoopTiming::kRotors, LoopTiming::kDirect),
                         [](const auto& info) {
                           return info.param == LoopTiming::kRotors ? "rotors" : "direct";
                         });

}  // namespace
}  // namespace trident::sim
