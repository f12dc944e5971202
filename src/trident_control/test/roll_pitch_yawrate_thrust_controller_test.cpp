// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control/roll_pitch_yawrate_thrust_controller.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "reference_model.h"

namespace trident::control {
namespace {

TEST(RollPitchYawrateThrust, agrees_with_a_scalar_derivation) {
  RollPitchYawrateThrustParams params;
  params.quirks.omit_gyroscopic_term = false;
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const int rotors : {4, 6, 8}) {
    params.vehicle = test::regular_multirotor(rotors, 0.25, 0.2);
    const RollPitchYawrateThrustController controller(params);
    std::vector<double> speeds(static_cast<std::size_t>(rotors));
    for (int trial = 0; trial < 300; ++trial) {
      const OdometryState state = test::random_state(random);
      const AttitudeCommand command{unit(random), unit(random), unit(random),
                                    20.0 + 5.0 * unit(random)};
      ASSERT_EQ(controller.compute(state, command, speeds), ControlStatus::ok);
      const std::vector<double> expected = test::reference_attitude_speeds(
          params.vehicle, params.gains, params.quirks, state, command);
      for (std::size_t i = 0; i < speeds.size(); ++i) {
        EXPECT_NEAR(speeds[i] * speeds[i], expected[i] * expected[i],
                    1e-6 * (1e4 + expected[i] * expected[i]));
      }
    }
  }
}

TEST(RollPitchYawrateThrust, level_command_gives_pure_thrust_at_any_heading) {
  const RollPitchYawrateThrustParams params;
  const RollPitchYawrateThrustController controller(params);
  OdometryState state;
  state.R_world_body = Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ());
  std::vector<double> speeds(6);
  ASSERT_EQ(controller.compute(state, {0, 0, 0, 15.0}, speeds), ControlStatus::ok);
  const std::array<double, 4> wrench = test::wrench_of(params.vehicle, speeds);
  EXPECT_NEAR(wrench[3], 15.0, 1e-9);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(wrench[i], 0.0, 1e-9);
}

TEST(RollPitchYawrateThrust, refuses_nan_and_wrong_length) {
  const RollPitchYawrateThrustController controller{RollPitchYawrateThrustParams{}};
  std::vector<double> speeds(6, 7.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const AttitudeCommand& bad :
       {AttitudeCommand{nan, 0, 0, 1}, AttitudeCommand{0, nan, 0, 1}, AttitudeCommand{0, 0, nan, 1},
        AttitudeCommand{0, 0, 0, nan}}) {
    EXPECT_EQ(controller.compute({}, bad, speeds), ControlStatus::invalid_reference);
  }
  OdometryState state;
  state.w_body.x() = nan;
  EXPECT_EQ(controller.compute(state, {}, speeds), ControlStatus::invalid_state);
  EXPECT_EQ(speeds, std::vector<double>(6, 7.0));
  std::vector<double> seven(7);
  EXPECT_EQ(controller.compute({}, {}, seven), ControlStatus::wrong_rotor_count);
}

}  // namespace
}  // namespace trident::control
