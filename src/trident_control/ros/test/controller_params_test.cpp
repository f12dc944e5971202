// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control_ros/controller_params.h"

#include <gtest/gtest.h>

#include <string>

namespace trident::control {
namespace {

using XmlRpc::XmlRpcValue;

XmlRpcValue rotor(double angle, int direction) {
  XmlRpcValue value;
  value["angle"] = angle;
  value["arm_length"] = 0.2;
  value["rotor_force_constant"] = 8e-6;
  value["rotor_moment_constant"] = 0.016;
  value["direction"] = direction;
  return value;
}

XmlRpcValue quadrotor() {
  XmlRpcValue value;
  value["mass"] = 1;
  for (int i = 0; i < 4; ++i) {
    value["rotor_configuration"][std::to_string(i)] = rotor(1.5707963 * i, i % 2 == 0 ? 1 : -1);
  }
  return value;
}

std::string error_of(const XmlRpcValue& value) {
  try {
    ros_utils::NodeParams(value, "/uav/lee").read<LeeNodeParams>();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ControllerParams, NoParametersAreTheFirefly) {
  const auto params = ros_utils::NodeParams(XmlRpcValue(), "/n").read<LeeNodeParams>().controller();
  const LeeParams expected;
  EXPECT_EQ(params.vehicle.rotors.size(), expected.vehicle.rotors.size());
  for (std::size_t i = 0; i < expected.vehicle.rotors.size(); ++i) {
    EXPECT_EQ(params.vehicle.rotors[i].angle, expected.vehicle.rotors[i].angle);
    EXPECT_EQ(params.vehicle.rotors[i].direction, expected.vehicle.rotors[i].direction);
  }
  EXPECT_EQ(params.vehicle.inertia, expected.vehicle.inertia);
  EXPECT_EQ(params.gains.position, expected.gains.position);
  EXPECT_EQ(params.gains.angular_rate, expected.gains.angular_rate);
}

TEST(ControllerParams, RotorsAreOrderedByNumberAndInertiaIsSymmetric) {
  XmlRpcValue value = quadrotor();
  for (int i = 4; i < 12; ++i) value["rotor_configuration"][std::to_string(i)] = rotor(i, 1);
  value["inertia"]["xy"] = 0.001;
  value["position_gain"]["z"] = 9;
  const auto params = ros_utils::NodeParams(value, "/n").read<LeeNodeParams>().controller();
  ASSERT_EQ(params.vehicle.rotors.size(), 12U);
  EXPECT_EQ(params.vehicle.rotors[11].angle, 11.0);
  EXPECT_EQ(params.vehicle.inertia(1, 0), 0.001);
  EXPECT_EQ(params.gains.position, Eigen::Vector3d(6.0, 6.0, 9.0));
}

TEST(ControllerParams, ErrorsNameTheRotor) {
  XmlRpcValue gap = quadrotor();
  gap["rotor_configuration"]["7"] = rotor(0.0, 1);
  EXPECT_EQ(error_of(gap),
            "parameter /uav/lee: rotor_configuration has the rotors 0, 1, 2, 3, 7, must be 0, 1, 2 "
            "... without a gap");
  XmlRpcValue direction = quadrotor();
  direction["rotor_configuration"]["2"]["direction"] = 0;
  EXPECT_EQ(error_of(direction),
            "parameter /uav/lee: rotor_configuration/2/direction is 0, must be 1 (ccw) or -1 (cw)");
}

TEST(ControllerParams, OnlyRotorsParametersAreNotedWhenAbsent) {
  XmlRpcValue value = quadrotor();
  value["inertia"]["xx"] = 0.03;
  ros_utils::NodeParams params(value, "/n");
  params.read<RollPitchYawrateThrustNodeParams>();
  const std::vector<std::string> notes = absent_notes(params);
  ASSERT_EQ(notes.size(), 11U);  // two gains, five of the inertia
  EXPECT_EQ(notes.front(), "parameter /n/attitude_gain/x is not set, using 3");
  EXPECT_EQ(notes.back(), "parameter /n/inertia/zz is not set, using 0.0977");
}

void expect_page(const std::string& name, const std::string& what, const std::string& table) {
  const std::string page = ros_utils::params_page(
      name, "Private parameters of " + what + ", printed from the node's struct.", table);
  EXPECT_EQ(ros_utils::page_on_disk(PARAMETER_PAGES "/" + name + ".md", page), page)
      << "set TRIDENT_WRITE_DOCS=1 to write it";
}

TEST(ControllerParams, TheReferenceIsThatOfTheStructs) {
  expect_page("lee_position_controller_node", "RotorS' position controller",
              ros_utils::document_params<LeeNodeParams>());
  expect_page("roll_pitch_yawrate_thrust_controller_node", "RotorS' attitude controller",
              ros_utils::document_params<RollPitchYawrateThrustNodeParams>());
  expect_page("vessel_controller_node", "the controller of a surface vessel",
              ros_utils::document_params<VesselNodeParams>());
}

}  // namespace
}  // namespace trident::control
