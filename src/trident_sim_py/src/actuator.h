// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "trident_base/span.h"
#include "trident_sim/model.h"
#include "trident_sim/port.h"

namespace trident::sim {

/// What an action drives. A command is middle + reach * action, action within [-1, 1].
struct ActuatorSpec {
  std::string kind;                   ///< see actuator_kinds()
  std::vector<std::string> ports;     ///< inputs that take the commands
  std::vector<double> middle, reach;  ///< as many as an action has numbers
};

/// Writes commands to the inputs of one model.
class Actuator {
 public:
  /// Of as many numbers as an action has.
  explicit Actuator(const ActuatorSpec& spec) : middle_(spec.middle), reach_(spec.reach) {}
  virtual ~Actuator() = default;
  Actuator(const Actuator&) = delete;
  Actuator& operator=(const Actuator&) = delete;

  /// Numbers of an action.
  std::size_t size() const { return middle_.size(); }
  double middle(std::size_t i) const { return middle_[i]; }
  double reach(std::size_t i) const { return reach_[i]; }
  /// An episode begins with the model as it is.
  virtual void begin(const Model& /*model*/) {}
  /// Holds for `period_s` from now on.
  virtual void apply(Span<const double> command, const Model& model, double period_s) = 0;

 private:
  std::vector<double> middle_, reach_;
};

/// `rotors`: speeds [rad/s] to an input of motor commands. `rates`: body rates [rad/s] and thrust
/// [N] to one of trajectories. `velocity`: velocity [m/s] and yaw rate [rad/s] in the world, to the
/// same. `thrusters`: numbers to an input each. `twist`: speed ahead [m/s] and yaw rate [rad/s] to
/// a cmd_vel.
std::vector<std::string> actuator_kinds();

/// Throws Error when an input is not there, or takes other commands.
std::unique_ptr<Actuator> make_actuator(const ActuatorSpec& spec, const PortBoard& board);

}  // namespace trident::sim
