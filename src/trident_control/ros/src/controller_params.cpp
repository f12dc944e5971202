// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control_ros/controller_params.h"

#include <array>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::control {
namespace {

/// Parameters that every file of RotorS has: a vehicle without them flies with those of another.
constexpr std::array<const char*, 7> kRotorsNames = {
    "position_gain", "velocity_gain", "attitude_gain",      "angular_rate_gain",
    "mass",          "inertia",       "rotor_configuration"};

bool is_of_rotors(const std::string& name) {
  const std::string top = name.substr(0, name.find('/'));
  return std::find(kRotorsNames.begin(), kRotorsNames.end(), top) != kRotorsNames.end();
}

}  // namespace

std::map<std::string, RotorParams> MultirotorParams::firefly_rotors() {
  std::map<std::string, RotorParams> result;
  for (const RotorConfig& rotor : VehicleParams::firefly_rotors()) {
    result.emplace(std::to_string(result.size()), RotorParams{rotor});
  }
  return result;
}

VehicleParams MultirotorParams::vehicle() const {
  VehicleParams vehicle;
  vehicle.mass = mass;
  vehicle.gravity = gravity;
  vehicle.inertia = inertia.matrix();
  vehicle.rotors.clear();
  // By number and not in the order of the map, in which the text "10" comes before "2".
  for (std::size_t i = 0; i < rotors.size(); ++i) {
    const auto named = rotors.find(std::to_string(i));
    if (named == rotors.end()) {
      std::vector<std::string> names;
      for (const auto& [name, rotor] : rotors) names.push_back(name);
      throw Error("rotor_configuration has the rotors " + join(names) +
                  ", must be 0, 1, 2 ... without a gap");
    }
    vehicle.rotors.push_back(named->second.rotor);
  }
  return vehicle;
}

void MultirotorParams::validate() const {
  for (const auto& [name, params] : rotors) {
    if (params.rotor.direction == 0) {
      throw Error("rotor_configuration/" + name + "/direction is 0, must be 1 (ccw) or -1 (cw)");
    }
  }
  vehicle().validate();
}

LeeParams LeeNodeParams::controller() const {
  LeeParams params;
  static_cast<AttitudeGains&>(params.gains) = multirotor.attitude_gains();
  params.gains.position = position_gain.value;
  params.gains.velocity = velocity_gain.value;
  params.vehicle = multirotor.vehicle();
  params.quirks = multirotor.quirks;
  return params;
}

/// Parameters of this project's own have defaults that suit every vehicle and are not mentioned.
std::vector<std::string> absent_notes(const ros_utils::NodeParams& params) {
  std::vector<std::string> notes;
  for (const ros_utils::AbsentParam& absent : params.absent()) {
    if (!is_of_rotors(absent.name)) continue;
    notes.push_back("parameter " + params.name_space() + '/' + absent.name + " is not set, using " +
                    absent.default_value);
  }
  return notes;
}

}  // namespace trident::control
