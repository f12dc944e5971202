// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <map>
#include <string>

#include "trident_base/error.h"
#include "trident_control_sim/lee_plugin.h"

namespace trident::control {
namespace {

/// Reads one file of flat maps of numbers; what is absent keeps its value.
class LeeYaml {
 public:
  LeeYaml(const std::string& file, LeeParams& params) : file_(file), params_(params) {}

  void read() {
    YAML::Node root;
    try {
      root = YAML::LoadFile(file_);
    } catch (const YAML::BadFile&) {
      throw Error(file_ + ": cannot be read");
    } catch (const YAML::Exception& error) {
      throw Error(file_ + ":" + std::to_string(error.mark.line + 1) + ": " + error.msg);
    }
    if (!root.IsMap()) throw Error(file_ + ": expected a map of parameters");
    for (const auto& entry : root) read_entry(entry.first.as<std::string>(), entry.second);
  }

 private:
  [[noreturn]] void refuse(const YAML::Node& node, const std::string& key,
                           const std::string& legal) {
    const std::string value = node.IsScalar() ? "'" + node.Scalar() + "'" : "not a number";
    throw Error(file_ + ":" + std::to_string(node.Mark().line + 1) + ": " + key + " is " + value +
                ", legal: " + legal);
  }

  double number(const YAML::Node& node, const std::string& key) {
    double value = 0.0;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value)) {
      refuse(node, key, "a finite number");
    }
    return value;
  }

  void vector(const YAML::Node& node, const std::string& key, Eigen::Vector3d& value) {
    if (!node.IsMap()) refuse(node, key, "{x: , y: , z: }");
    for (const auto& entry : node) {
      const auto axis = std::string("xyz").find(entry.first.as<std::string>());
      if (axis == std::string::npos) refuse(entry.first, key, "axes x, y, z");
      value[static_cast<Eigen::Index>(axis)] = number(entry.second, key);
    }
  }

  // RotorS gives one triangle of the symmetric matrix.
  void inertia(const YAML::Node& node) {
    for (const auto& entry : node) {
      const std::string name = entry.first.as<std::string>();
      const auto row = name.size() == 2 ? std::string("xyz").find(name[0]) : std::string::npos;
      const auto column = name.size() == 2 ? std::string("xyz").find(name[1]) : std::string::npos;
      if (row == std::string::npos || column == std::string::npos) {
        refuse(entry.first, "inertia", "xx, xy, xz, yy, yz, zz");
      }
      const double value = number(entry.second, "inertia/" + name);
      const auto i = static_cast<Eigen::Index>(row), j = static_cast<Eigen::Index>(column);
      params_.vehicle.inertia(i, j) = params_.vehicle.inertia(j, i) = value;
    }
  }

  // A map from the rotor's number to its parameters, as RotorS writes it.
  void rotors(const YAML::Node& node) {
    params_.vehicle.rotors.assign(node.size(), {});
    for (const auto& entry : node) {
      const std::string name = entry.first.as<std::string>();
      const YAML::Node index = entry.first;
      std::size_t i = 0;
      if (!YAML::convert<std::size_t>::decode(index, i) || i >= node.size()) {
        refuse(index, "rotor_configuration", "0 to " + std::to_string(node.size() - 1));
      }
      rotor(entry.second, "rotor_configuration/" + name, params_.vehicle.rotors[i]);
    }
  }

  void rotor(const YAML::Node& node, const std::string& key, RotorConfig& rotor) {
    static const std::map<std::string, double RotorConfig::*> kNumbers = {
        {"angle", &RotorConfig::angle},
        {"arm_length", &RotorConfig::arm_length},
        {"rotor_force_constant", &RotorConfig::force_constant},
        {"rotor_moment_constant", &RotorConfig::moment_constant}};
    for (const auto& entry : node) {
      const std::string name = entry.first.as<std::string>();
      const double value = number(entry.second, key + "/" + name);
      if (const auto found = kNumbers.find(name); found != kNumbers.end()) {
        rotor.*found->second = value;
      } else if (name == "direction") {
        rotor.direction = value > 0.0 ? 1 : -1;
      } else {
        refuse(entry.first, key,
               "angle, arm_length, rotor_force_constant, rotor_moment_constant, direction");
      }
    }
  }

  void read_entry(const std::string& key, const YAML::Node& node) {
    static const std::map<std::string, Eigen::Vector3d LeeGains::*> kGains = {
        {"position_gain", &LeeGains::position},
        {"velocity_gain", &LeeGains::velocity},
        {"attitude_gain", &LeeGains::attitude},
        {"angular_rate_gain", &LeeGains::angular_rate}};
    if (const auto found = kGains.find(key); found != kGains.end()) {
      vector(node, key, params_.gains.*found->second);
    } else if (key == "mass") {
      params_.vehicle.mass = number(node, key);
    } else if (key == "inertia") {
      inertia(node);
    } else if (key == "rotor_configuration") {
      rotors(node);
    } else {
      refuse(node, "'" + key + "', an unknown key,",
             "position_gain, velocity_gain, attitude_gain, angular_rate_gain, mass, inertia, "
             "rotor_configuration");
    }
  }

  const std::string& file_;
  LeeParams& params_;
};

}  // namespace

LeeParams load_lee_params(const std::vector<std::string>& files) {
  LeeParams params;
  // RotorS keeps vehicle and gains in two files; a later file overrides an earlier one.
  for (const std::string& file : files) LeeYaml(file, params).read();
  return params;
}

}  // namespace trident::control
