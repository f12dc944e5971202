// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <string>
#include <vector>

#include "trident_control/lee_position_controller.h"
#include "trident_control/roll_pitch_yawrate_thrust_controller.h"
#include "trident_control/setpoint_queue.h"

namespace trident::control {

/// Reads RotorS' parameter names (position_gain/x, mass, inertia/xx, rotor_configuration/0/angle
/// ...) out of one parameter tree. What is absent keeps its default and is noted; what is of the
/// wrong type or out of range throws trident::Error with the full name, the value and what it
/// should be.
class ParameterTree {
 public:
  /// `name_space`: how error texts call the root, "/UAV1/lee_position_controller_node" for
  /// instance.
  ParameterTree(const XmlRpc::XmlRpcValue& root, std::string name_space);

  /// The whole private tree of a node, in one call to the master.
  static ParameterTree of_node(const ros::NodeHandle& private_handle);

  LeeParams lee_params();
  RollPitchYawrateThrustParams roll_pitch_yawrate_thrust_params();
  SetpointQueueParams setpoint_queue_params();
  /// A text that must be there, `expected` says what it stands for.
  std::string required_text(const std::string& name, const std::string& expected);

  /// One sentence per absent parameter with a RotorS name, in the order they were asked for.
  const std::vector<std::string>& notes() const { return notes_; }
  /// Names in the tree that nothing has asked for: misspelt ones, mostly.
  std::vector<std::string> unknown_names() const;

 private:
  enum class IfAbsent { note, silent };

  void read(const std::string& name, double& value, IfAbsent if_absent = IfAbsent::note);
  void read(const std::string& name, bool& value);
  void read_xyz(const std::string& name, Eigen::Vector3d& value);
  void read_inertia(Eigen::Matrix3d& inertia);
  void read_rotors(std::vector<RotorConfig>& rotors);
  void read_vehicle(VehicleParams& vehicle);
  void read_attitude_gains(AttitudeGains& gains);
  void read_quirks(AttitudeQuirks& quirks);
  XmlRpc::XmlRpcValue* find(const std::string& name);
  [[noreturn]] void refuse(const std::string& name, const XmlRpc::XmlRpcValue& value,
                           const std::string& expected) const;

  XmlRpc::XmlRpcValue root_;
  std::string name_space_;
  std::vector<std::string> notes_;
  std::vector<std::string> asked_for_;  // first component of each name
};

}  // namespace trident::control
