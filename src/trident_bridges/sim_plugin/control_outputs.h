// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "trident_sim/samples.h"
#include "trident_sim/world.h"

namespace trident::bridges {

/// Where an autopilot's channels act: motors by their numbers, through the port of the motor
/// models, and joints with a drive.
class ControlOutputs {
 public:
  /// `owner` begins reports; `motor_topic` is the full name of the motors' input.
  ControlOutputs(const sim::PluginContext& context, const std::string& motor_topic);
  /// Takes the drives away.
  ~ControlOutputs();
  ControlOutputs(const ControlOutputs&) = delete;
  ControlOutputs& operator=(const ControlOutputs&) = delete;

  /// The next channel is a motor. Throws Error beyond 32 motors.
  void add_motor(std::size_t number);
  /// The next channel drives the first axis of a joint. Throws Error as World::add_drive() does.
  void add_joint(sim::Joint& joint, const sim::DriveSpec& spec);
  /// The next channel acts on nothing.
  void add_nothing() { channels_.push_back({}); }

  /// Sets a channel's target: rotor speed [rad/s], or the drive's. A value that is not finite or
  /// beyond 1e6 is refused, reported as of `field`, and the last one stays.
  void set(std::size_t channel, double value, const std::string& field);
  /// Hands the motors their speeds.
  void flush(SimTime now);
  void reset();                                                 ///< all motors stand
  void state(sim::StateArchive& archive) { archive(speeds_); }  ///< the motors' speeds

 private:
  struct Channel {
    int motor = -1;               ///< its number; -1: no motor
    sim::Joint* joint = nullptr;  ///< with a drive
  };

  sim::World& world_;
  std::string owner_;
  std::vector<Channel> channels_;
  sim::SmallVector speeds_;
  sim::InHandle<sim::ActuatorCommand> motors_;
  sim::OutHandle<sim::ActuatorState> commanded_;  ///< the same, for who listens
};

/// A joint of a model by its name, also by what follows the last "::"; nullptr: it has none.
sim::Joint* find_joint(const sim::Model& model, const std::string& name);

/// Whether there is a joint, and it turns a rotor of a motor model.
inline bool is_rotor(const sim::Joint* joint) { return joint != nullptr && joint->is_rotor; }
/// Whether there is a joint, and it can move.
inline bool can_move(const sim::Joint* joint) {
  return joint != nullptr && joint->axis_count() > 0;
}

/// "a, b, c": the joints of a model for which `counts` is true.
std::string joint_names(const sim::Model& model, bool (*counts)(const sim::Joint*));

/// Reports, once each, the elements of `params` that nothing has read.
void report_unread(sim::World& world, const sim::PluginParams& params);

}  // namespace trident::bridges
