// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "trident_base/yaml_config.h"

namespace trident {

enum class Timing { kDirect, kRotors };

constexpr auto enum_names(Timing) {
  return std::array{EnumName{Timing::kDirect, "direct"}, EnumName{Timing::kRotors, "rotors"}};
}

/// One field of every kind.
struct RotorConfig {
  double force_constant = 8.5e-6;
  int direction = 1;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("force_constant", force_constant, Range{0, 1}, "thrust per squared speed [N s^2]");
    ar.field("direction", direction, Range{-1, 1}, "1: counter-clockwise");
  }
  void validate() const {
    if (direction == 0) throw Error("direction = 0 must be -1 or 1");
  }
};

struct VehicleConfig {
  std::string name = "firefly";
  bool enable_logging = false;
  double mass = 1.5;
  float scale = 1.0F;
  std::uint8_t slots = 3;
  std::int64_t offset = 0;
  std::uint64_t seed = 0;
  Timing timing = Timing::kDirect;
  RotorConfig spare;
  std::vector<RotorConfig> rotors;
  std::array<double, 2> limits = {-1, 1};
  Eigen::Vector3d inertia = Eigen::Vector3d::Ones();
  Eigen::VectorXd gains;
  std::optional<double> max_range;
  std::map<std::string, double> weights;
  std::map<std::string, std::vector<int>> groups;
  std::vector<Timing> modes;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("name", name, "shown in rviz");
    ar.field("enable_logging", enable_logging);
    ar.field("mass", mass, Range::positive(), "of the whole vehicle [kg]");
    ar.field("scale", scale, "a | b");
    ar.field("slots", slots);
    ar.field("offset", offset);
    ar.field("seed", seed);
    ar.field("timing", timing, "when a command acts");
    ar.field("spare", spare);
    ar.field("rotors", rotors, "in the order of the mixer");
    ar.field("limits", limits, Range{-10, 10, false, true}, "pitch, roll [rad]");
    ar.field("inertia", inertia, Range::positive(), "principal moments [kg m^2]");
    ar.field("gains", gains);
    ar.field("max_range", max_range, Range::positive().or_infinite(), "none: unlimited [m]");
    ar.field("weights", weights, Range{0, 1});
    ar.field("groups", groups);
    ar.field("modes", modes);
  }
};

struct StrictConfig {
  double rate = 0.0;
  RotorConfig rotor;

  template <class Archive>
  void visit(Archive& ar) {
    ar.required("rate", rate, Range::positive(), "update rate [Hz]");
    ar.required("rotor", rotor, "the only rotor");
  }
};

}  // namespace trident
