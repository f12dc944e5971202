// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "reference_model.h"
#include "trident_control/lee_position_controller.h"

namespace trident::control {
namespace {

/// Ideal rotors on a rigid body, semi-implicit Euler.
class RigidMultirotor {
 public:
  explicit RigidMultirotor(const VehicleParams& vehicle) : vehicle_(vehicle) {}

  void step(const std::vector<double>& speeds, double dt) {
    const std::array<double, 4> wrench = test::wrench_of(vehicle_, speeds);
    const Eigen::Vector3d torque(wrench[0], wrench[1], wrench[2]);
    const Eigen::Vector3d w = state.w_body;
    state.w_body += dt * (vehicle_.inertia.inverse() *
                          (torque - w.cross(Eigen::Vector3d(vehicle_.inertia * w))));
    const double angle = state.w_body.norm() * dt;
    if (angle > 0.0) {
      state.R_world_body =
          (state.R_world_body * Eigen::AngleAxisd(angle, state.w_body.normalized())).normalized();
    }
    v_world += dt * (state.R_world_body * Eigen::Vector3d(0, 0, wrench[3]) / vehicle_.mass -
                     Eigen::Vector3d(0, 0, vehicle_.gravity));
    state.p_world_body += dt * v_world;
    state.v_body = state.R_world_body.conjugate() * v_world;
  }

  OdometryState state;
  Eigen::Vector3d v_world = Eigen::Vector3d::Zero();

 private:
  VehicleParams vehicle_;
};

LeeParams tuned(int rotors) {
  LeeParams params;
  if (rotors != 6) params.vehicle = test::regular_multirotor(rotors, 0.215, 0.3);
  params.gains.attitude = {3.0, 3.0, 0.15};
  params.gains.angular_rate = {0.52, 0.52, 0.18};
  return params;
}

class ClosedLoop : public testing::TestWithParam<int> {};

TEST_P(ClosedLoop, converges_to_a_pose_from_any_moderate_state) {
  const LeeParams params = tuned(GetParam());
  const LeePositionController controller(params);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int trial = 0; trial < 10; ++trial) {
    RigidMultirotor vehicle(params.vehicle);
    vehicle.state.p_world_body = Eigen::Vector3d(unit(random), unit(random), unit(random));
    vehicle.state.R_world_body = Eigen::AngleAxisd(0.5 * unit(random), Eigen::Vector3d::UnitX()) *
                                 Eigen::AngleAxisd(0.5 * unit(random), Eigen::Vector3d::UnitY());
    vehicle.state.w_body = Eigen::Vector3d(unit(random), unit(random), unit(random));
    TrajectoryPoint goal;
    goal.p_world = Eigen::Vector3d(1.0, -0.5, 2.0);
    goal.yaw = 1.0;
    std::vector<double> speeds(params.vehicle.rotors.size());
    for (int i = 0; i < 8000; ++i) {
      ASSERT_EQ(controller.compute(vehicle.state, goal, speeds), ControlStatus::ok);
      vehicle.step(speeds, 0.002);
    }
    EXPECT_LT((vehicle.state.p_world_body - goal.p_world).norm(), 1e-3);
    EXPECT_NEAR(yaw_from_quaternion(vehicle.state.R_world_body), 1.0, 1e-3);
    EXPECT_LT(vehicle.v_world.norm(), 1e-3);
  }
}

TEST_P(ClosedLoop, follows_a_circle_with_feed_forward_to_the_millimetre) {
  const LeeParams params = tuned(GetParam());
  const LeePositionController controller(params);
  RigidMultirotor vehicle(params.vehicle);
  const double rate = 0.5;  // rad/s on a circle of 1 m
  std::vector<double> speeds(params.vehicle.rotors.size());
  double worst = 0.0;
  for (int i = 0; i < 15000; ++i) {
    const double phase = rate * i * 0.002;
    TrajectoryPoint point;
    point.p_world = Eigen::Vector3d(std::cos(phase), std::sin(phase), 1.0);
    point.v_world = rate * Eigen::Vector3d(-std::sin(phase), std::cos(phase), 0.0);
    point.a_world = -rate * rate * Eigen::Vector3d(std::cos(phase), std::sin(phase), 0.0);
    ASSERT_EQ(controller.compute(vehicle.state, point, speeds), ControlStatus::ok);
    if (i > 10000) worst = std::max(worst, (vehicle.state.p_world_body - point.p_world).norm());
    vehicle.step(speeds, 0.002);
  }
  EXPECT_LT(worst, 0.02);
}

INSTANTIATE_TEST_SUITE_P(RotorCounts, ClosedLoop, testing::Values(4, 6, 8));

}  // namespace
}  // namespace trident::control
