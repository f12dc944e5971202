// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "core/plugins/stamped_commands.h"
#include "trident_sim/plugin_registry.h"

namespace trident::sim {
namespace {

/// Passes rotor speed commands on to the motors, each at its time (StampedCommands).
class ControllerInterface : public Plugin {
 public:
  explicit ControllerInterface(const PluginContext& context)
      : name_(context.params.owner()), commands_(context, command_topic(context.params)) {
    const PluginParams& params = context.params;
    // Upstream's, of inputs that its plugin reads and does nothing with.
    for (const char* unused : {"linkName", "imuSubTopic", "commandAttitudeThrustSubTopic",
                               "commandRateThrustSubTopic"}) {
      params.node(unused);
    }
    const std::string out = scoped_topic(
        params, params.text("motorSpeedCommandPubTopic", "gazebo/command/motor_speed"));
    to_motors_ = subscribe<ActuatorCommand>(context, out);
    out_ = advertise<ActuatorState>(context, out, PortRank::kState);
  }

  std::vector<Phase> phases() const override { return {Phase::kControl}; }

  void pre_step(Phase, World& world, const StepInfo& info) override {
    const ActuatorCommand* command = commands_.take_due(info);
    if (command != nullptr && accept(world, *command)) to_motors_->write(*command);
    if (out_->wanted() && to_motors_->count() > 0) {
      out_->value.stamp = info.end;
      out_->value.angular_velocities = to_motors_->at(to_motors_->count() - 1).angular_velocities;
      out_->publish();
    }
  }

  void reset() override {
    commands_.reset();
    to_motors_->clear();
    refused_ = false;
  }
  void state(StateArchive& archive) override {
    commands_.state(archive);
    archive(refused_);
  }

 private:
  static std::string command_topic(const PluginParams& params) {
    return scoped_topic(params, params.text("commandMotorSpeedSubTopic", "command/motor_speed"));
  }

  bool accept(World& world, const ActuatorCommand& command) {
    const auto speeds = command.angular_velocities.view();
    const auto bad = std::find_if(speeds.begin(), speeds.end(),
                                  [](double speed) { return !std::isfinite(speed); });
    if (bad == speeds.end()) {
      refused_ = false;
      return true;
    }
    if (!refused_) {
      world.report(
          Severity::kError,
          name_ + ": motor command " + std::to_string(bad - speeds.begin()) + " is " +
              std::to_string(*bad) +
              " rad/s, must be finite; such commands are refused, the last good one stays");
    }
    refused_ = true;
    return false;
  }

  std::string name_;
  bool refused_ = false;
  StampedCommands commands_;
  InHandle<ActuatorCommand> to_motors_;
  OutHandle<ActuatorState> out_;
};

const PluginRegistrar kRotorsGazeboControllerInterface(
    "librotors_gazebo_controller_interface.so", factory_of<ControllerInterface>(),
    PluginExample{"<linkName>base_link</linkName>", {}, {}});

}  // namespace

}  // namespace trident::sim
