// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control_ros/parameters.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "trident_base/error.h"

namespace trident::control {
namespace {

using XmlRpc::XmlRpcValue;

XmlRpcValue* member(XmlRpcValue& tree, const std::string& name) {
  if (tree.getType() != XmlRpcValue::TypeStruct || !tree.hasMember(name)) return nullptr;
  return &tree[name];
}

}  // namespace

ParameterTree::ParameterTree(const XmlRpcValue& root, std::string name_space)
    : root_(root), name_space_(std::move(name_space)) {}

ParameterTree ParameterTree::of_node(const ros::NodeHandle& private_handle) {
  XmlRpcValue root;
  private_handle.getParam("", root);  // absent: stays empty, everything takes its default
  return {root, private_handle.getNamespace()};
}

XmlRpcValue* ParameterTree::find(const std::string& name) {
  const std::string top = name.substr(0, name.find('/'));
  if (std::find(asked_for_.begin(), asked_for_.end(), top) == asked_for_.end()) {
    asked_for_.push_back(top);
  }
  XmlRpcValue* value = &root_;
  std::istringstream parts(name);
  for (std::string part; value && std::getline(parts, part, '/');) value = member(*value, part);
  return value;
}

void ParameterTree::refuse(const std::string& name, const XmlRpcValue& value,
                           const std::string& expected) const {
  std::ostringstream text;
  value.write(text);
  throw Error("parameter '" + name_space_ + "/" + name + "' is " + text.str() + ": it must be " +
              expected);
}

void ParameterTree::read(const std::string& name, double& value, IfAbsent if_absent) {
  XmlRpcValue* found = find(name);
  if (!found) {
    if (if_absent == IfAbsent::silent) return;
    std::ostringstream note;
    note << "parameter '" << name_space_ << "/" << name << "' is not set, using " << value;
    notes_.push_back(note.str());
    return;
  }
  if (found->getType() == XmlRpcValue::TypeInt) {
    value = static_cast<int&>(*found);
  } else if (found->getType() == XmlRpcValue::TypeDouble) {
    value = static_cast<double&>(*found);
  } else {
    refuse(name, *found, "a number");
  }
  if (!std::isfinite(value)) refuse(name, *found, "a finite number");
}

void ParameterTree::read(const std::string& name, bool& value) {
  XmlRpcValue* found = find(name);
  if (!found) return;
  if (found->getType() != XmlRpcValue::TypeBoolean) refuse(name, *found, "true or false");
  value = static_cast<bool&>(*found);
}

void ParameterTree::read_xyz(const std::string& name, Eigen::Vector3d& value) {
  read(name + "/x", value.x());
  read(name + "/y", value.y());
  read(name + "/z", value.z());
  XmlRpcValue* found = find(name);
  if (found && !(value.array() >= 0.0).all()) refuse(name, *found, "three numbers >= 0");
}

void ParameterTree::read_inertia(Eigen::Matrix3d& inertia) {
  const char* const axes = "xyz";
  for (int row = 0; row < 3; ++row) {
    for (int column = row; column < 3; ++column) {
      read(std::string("inertia/") + axes[row] + axes[column], inertia(row, column));
      inertia(column, row) = inertia(row, column);
    }
  }
}

void ParameterTree::read_rotors(std::vector<RotorConfig>& rotors) {
  XmlRpcValue* list = find("rotor_configuration");
  if (!list) {
    notes_.push_back("parameter '" + name_space_ + "/rotor_configuration' is not set, using the " +
                     std::to_string(rotors.size()) + " rotors of the firefly");
    return;
  }
  if (list->getType() != XmlRpcValue::TypeStruct) {
    refuse("rotor_configuration", *list, "rotors named 0, 1, 2 ...");
  }
  rotors.clear();
  const auto count = static_cast<std::size_t>(list->size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::string prefix = "rotor_configuration/" + std::to_string(i);
    if (!find(prefix))
      refuse("rotor_configuration", *list, "rotors named 0, 1, 2 ... without a gap");
    RotorConfig rotor;
    double direction = 0.0;
    for (const auto& [key, value] : {std::pair<const char*, double*>{"/angle", &rotor.angle},
                                     {"/arm_length", &rotor.arm_length},
                                     {"/rotor_force_constant", &rotor.force_constant},
                                     {"/rotor_moment_constant", &rotor.moment_constant},
                                     {"/direction", &direction}}) {
      if (!find(prefix + key)) {
        refuse(prefix, *find(prefix), std::string("a rotor that has '") + (key + 1) + "' too");
      }
      read(prefix + key, *value);
    }
    if (direction != 1.0 && direction != -1.0) {
      refuse(prefix + "/direction", *find(prefix + "/direction"), "1 (ccw) or -1 (cw)");
    }
    rotor.direction = direction > 0.0 ? 1 : -1;
    rotors.push_back(rotor);
  }
}

void ParameterTree::read_vehicle(VehicleParams& vehicle) {
  read("mass", vehicle.mass);
  read("gravity", vehicle.gravity, IfAbsent::silent);
  read_inertia(vehicle.inertia);
  read_rotors(vehicle.rotors);
  try {
    vehicle.validate();
  } catch (const Error& error) {
    throw Error("parameters of " + name_space_ + ": " + error.what());
  }
}

void ParameterTree::read_attitude_gains(AttitudeGains& gains) {
  read_xyz("attitude_gain", gains.attitude);
  read_xyz("angular_rate_gain", gains.angular_rate);
}

void ParameterTree::read_quirks(AttitudeQuirks& quirks) {
  read("rotate_yaw_rate_with_RdT_R", quirks.rotate_yaw_rate_with_RdT_R);
  read("omit_gyroscopic_term", quirks.omit_gyroscopic_term);
  read("unlimited_rotor_speed", quirks.unlimited_rotor_speed);
  read("max_rotor_speed", quirks.max_rotor_speed, IfAbsent::silent);
}

LeeParams ParameterTree::lee_params() {
  LeeParams params;
  read_xyz("position_gain", params.gains.position);
  read_xyz("velocity_gain", params.gains.velocity);
  read_attitude_gains(params.gains);
  read_vehicle(params.vehicle);
  read_quirks(params.quirks);
  return params;
}

RollPitchYawrateThrustParams ParameterTree::roll_pitch_yawrate_thrust_params() {
  RollPitchYawrateThrustParams params;
  read_attitude_gains(params.gains);
  read_vehicle(params.vehicle);
  read_quirks(params.quirks);
  return params;
}

SetpointQueueParams ParameterTree::setpoint_queue_params() {
  SetpointQueueParams params;
  read("first_point_at_start", params.first_point_at_start);
  read("keep_setpoint_over_reset", params.keep_setpoint_over_reset);
  read("max_setpoint_lead", params.max_lead_s, IfAbsent::silent);
  read("max_setpoint_age", params.max_age_s, IfAbsent::silent);
  return params;
}

std::string ParameterTree::required_text(const std::string& name, const std::string& expected) {
  XmlRpcValue* found = find(name);
  if (!found) {
    throw Error("parameter '" + name_space_ + "/" + name + "' is not set: it must be " + expected);
  }
  if (found->getType() != XmlRpcValue::TypeString) refuse(name, *found, expected);
  return static_cast<std::string&>(*found);
}

std::vector<std::string> ParameterTree::unknown_names() const {
  std::vector<std::string> names;
  if (root_.getType() != XmlRpcValue::TypeStruct) return names;
  for (auto it = root_.begin(); it != root_.end(); ++it) {
    if (std::find(asked_for_.begin(), asked_for_.end(), it->first) == asked_for_.end()) {
      names.push_back(it->first);
    }
  }
  return names;
}

}  // namespace trident::control
