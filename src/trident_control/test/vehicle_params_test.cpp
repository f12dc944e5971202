// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control/vehicle_params.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "reference_model.h"
#include "trident_base/error.h"

namespace trident::control {
namespace {

std::string error_of(const std::function<void(VehicleParams&)>& spoil) {
  VehicleParams vehicle;
  spoil(vehicle);
  try {
    allocation_matrix(vehicle);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

void expect_error(const std::function<void(VehicleParams&)>& spoil, const std::string& field,
                  const std::string& value) {
  const std::string error = error_of(spoil);
  EXPECT_NE(error.find("'" + field + "'"), std::string::npos) << error;
  EXPECT_NE(error.find(value), std::string::npos) << error;
  EXPECT_NE(error.find("must be"), std::string::npos) << error;
}

TEST(AllocationMatrix, firefly_columns_follow_the_rotor_equation) {
  const VehicleParams vehicle;
  const AllocationMatrix allocation = allocation_matrix(vehicle);
  ASSERT_EQ(allocation.cols(), 6);
  for (int i = 0; i < 6; ++i) {
    const RotorConfig& rotor = vehicle.rotors[static_cast<std::size_t>(i)];
    const double kf = rotor.force_constant;
    EXPECT_DOUBLE_EQ(allocation(0, i), std::sin(rotor.angle) * 0.215 * kf);
    EXPECT_DOUBLE_EQ(allocation(1, i), -std::cos(rotor.angle) * 0.215 * kf);
    EXPECT_DOUBLE_EQ(allocation(2, i), -rotor.direction * kf * 0.016);
    EXPECT_DOUBLE_EQ(allocation(3, i), kf);
  }
}

struct Layout {
  int rotors;
  double arm_length;
  double first_angle;
};

class AllocationOfLayout : public testing::TestWithParam<Layout> {};

TEST_P(AllocationOfLayout, inverse_is_a_right_inverse_of_minimum_norm) {
  const Layout layout = GetParam();
  const AllocationMatrix allocation = allocation_matrix(
      test::regular_multirotor(layout.rotors, layout.arm_length, layout.first_angle));
  const AllocationInverse inverse = allocation_inverse(allocation);
  EXPECT_TRUE((allocation * inverse).isIdentity(1e-9));
  // Minimum norm = the solution lies in the row space of A: (A+ A) is symmetric.
  const Eigen::MatrixXd projector = inverse * allocation;
  EXPECT_TRUE(projector.isApprox(projector.transpose(), 1e-9));
}

INSTANTIATE_TEST_SUITE_P(Layouts, AllocationOfLayout,
                         testing::Values(Layout{4, 0.17, 0.0}, Layout{4, 0.2, M_PI / 4},
                                         Layout{6, 0.215, M_PI / 6}, Layout{8, 0.4, M_PI / 8},
                                         Layout{16, 1.0, 0.1}));

TEST(AllocationMatrix, canted_rotors_give_side_torque_and_less_lift) {
  VehicleParams vehicle = test::regular_multirotor(6, 0.25, M_PI / 6);
  const double cant = 5.0 * M_PI / 180.0;
  for (RotorConfig& rotor :
       vehicle.rotors) {  // tilted about their own arm, away from their direction
    const Eigen::Vector3d arm(std::cos(rotor.angle), std::sin(rotor.angle), 0.0);
    rotor.thrust_axis_body =
        Eigen::AngleAxisd(-rotor.direction * cant, arm) * Eigen::Vector3d::UnitZ();
  }
  const AllocationMatrix allocation = allocation_matrix(vehicle);
  const double kf = vehicle.rotors[0].force_constant;
  for (int i = 0; i < 6; ++i) {
    const int direction = vehicle.rotors[static_cast<std::size_t>(i)].direction;
    EXPECT_NEAR(allocation(3, i), kf * std::cos(cant), 1e-18);
    // p x f about z: a rotor tilted by -dir cant about its arm pushes the vehicle in direction
    // -dir.
    const double expected =
        direction * 0.25 * kf * std::sin(cant) - direction * 0.016 * kf * std::cos(cant);
    EXPECT_NEAR(allocation(2, i), expected, 1e-18);
  }
  EXPECT_TRUE((allocation * allocation_inverse(allocation)).isIdentity(1e-9));
}

TEST(AllocationMatrix, refuses_layouts_that_cannot_turn_about_an_axis) {
  const auto expect_rank_3 = [](const std::function<void(VehicleParams&)>& spoil) {
    const std::string error = error_of(spoil);
    EXPECT_NE(error.find("rank 3"), std::string::npos) << error;
  };
  expect_rank_3([](VehicleParams& v) {
    for (RotorConfig& rotor : v.rotors) rotor.direction = 1;  // yaw follows thrust
  });
  expect_rank_3([](VehicleParams& v) {
    for (RotorConfig& rotor : v.rotors) rotor.moment_constant = 0.0;  // no yaw
  });
  expect_rank_3([](VehicleParams& v) {
    for (RotorConfig& rotor : v.rotors) rotor.angle = 0.0;  // all on one spot: roll gone
    v.rotors[1].angle = M_PI;
    v.rotors[2].angle = M_PI;
  });
}

TEST(VehicleParams, names_field_value_and_range_of_bad_input) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_error([](VehicleParams& v) { v.mass = -2.5; }, "mass", "-2.5");
  expect_error([&](VehicleParams& v) { v.mass = nan; }, "mass", "nan");
  expect_error([](VehicleParams& v) { v.gravity = -9.8; }, "gravity", "-9.8");
  expect_error([](VehicleParams& v) { v.inertia(1, 1) = 0.0; }, "inertia", "yy 0");
  expect_error([](VehicleParams& v) { v.inertia(0, 1) = 0.01; }, "inertia", "xy 0.01");
  expect_error([&](VehicleParams& v) { v.inertia(2, 2) = nan; }, "inertia", "zz nan");
  expect_error([](VehicleParams& v) { v.rotors.resize(3); }, "rotor_configuration", "3 rotors");
  expect_error([](VehicleParams& v) { v.rotors.resize(17, v.rotors[0]); }, "rotor_configuration",
               "17 rotors");
  expect_error([&](VehicleParams& v) { v.rotors[2].angle = nan; }, "rotor_configuration/2/angle",
               "nan");
  expect_error([](VehicleParams& v) { v.rotors[5].arm_length = 0.0; },
               "rotor_configuration/5/arm_length", "is 0");
  expect_error([](VehicleParams& v) { v.rotors[0].force_constant = -1e-6; },
               "rotor_configuration/0/rotor_force_constant", "-1e-06");
  expect_error([](VehicleParams& v) { v.rotors[0].moment_constant = -0.1; },
               "rotor_configuration/0/rotor_moment_constant", "-0.1");
  expect_error([](VehicleParams& v) { v.rotors[1].direction = 0; },
               "rotor_configuration/1/direction", "is 0");
  expect_error([](VehicleParams& v) { v.rotors[1].thrust_axis_body *= 0.5; },
               "rotor_configuration/1/thrust_axis_body", "length 0.5");
}

}  // namespace
}  // namespace trident::control
