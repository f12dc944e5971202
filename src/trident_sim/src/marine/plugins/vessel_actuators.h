// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "actuator_input.h"
#include "marine/vessel/rudder.h"
#include "marine/vessel/thruster.h"

namespace trident::sim {

/// A thruster on its topics below <robotNamespace>/thrusters: in <name>_thrust_cmd, and
/// <name>_thrust_angle [rad] where it turns; out <name>_thrust, what it gives [N].
class ThrusterOnTopics {
 public:
  /// After `timeout_s` without a command it stops; 0: never. With a `command_topic` commands are
  /// handed in instead, and errors name that.
  ThrusterOnTopics(const PluginContext& context, const ThrusterParams& params, double timeout_s,
                   const std::string& command_topic = "");

  bool turns() const { return angle_.has_value(); }
  void command(World& world, const StepInfo& info, double value);
  void command_angle(World& world, double angle_rad);
  /// Takes the commands that came on topics and advances by a step.
  void step(World& world, const StepInfo& info);
  /// In place of a message: `part` of the largest command of either sign, [-1, 1].
  void command_part(double part, const StepInfo& info);
  const Thruster& thruster() const { return thruster_; }
  void publish(SimTime stamp);
  void reset();
  void state(StateArchive& archive);

 private:
  Thruster thruster_;
  double timeout_s_;
  ActuatorInput command_;
  std::optional<ActuatorInput> angle_;
  OutHandle<ScalarSample> thrust_;
  SimTime commanded_;
};

/// A rudder on its topic <robotNamespace>/rudders/<name>_angle [rad].
class RudderOnTopic {
 public:
  RudderOnTopic(const PluginContext& context, const RudderParams& params,
                const std::string& command_topic = "");

  void command(World& world, double angle_rad);
  void step(World& world, const StepInfo& info);
  const Rudder& rudder() const { return rudder_; }
  void reset();
  void state(StateArchive& archive);

 private:
  Rudder rudder_;
  ActuatorInput angle_;
};

}  // namespace trident::sim
