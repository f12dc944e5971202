// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "../plugin_util.h"
#include "rotors_plugins.h"

namespace trident {
namespace {

/// Passes rotor speed commands on to the motors, each at its time: in `rotors` timing the answer to
/// the odometry stamped s acts in the step that begins at s + dt, in `direct` timing in the one
/// that begins at s. The stamp decides, never the moment of arrival, so a run can be repeated.
class ControllerInterface : public Plugin {
 public:
  explicit ControllerInterface(const PluginContext& context)
      : delayed_(context.world.timing() == LoopTiming::kRotors), name_(context.params.owner()) {
    const PluginParams& params = context.params;
    // Upstream's, of inputs that its plugin reads and does nothing with.
    for (const char* unused : {"linkName", "imuSubTopic", "commandAttitudeThrustSubTopic",
                               "commandRateThrustSubTopic"}) {
      params.node(unused);
    }
    const std::string out = scoped_topic(
        params, params.text("motorSpeedCommandPubTopic", "gazebo/command/motor_speed"));
    in_ = subscribe<ActuatorCommand>(
        context,
        scoped_topic(params, params.text("commandMotorSpeedSubTopic", "command/motor_speed")));
    to_motors_ = subscribe<ActuatorCommand>(context, out);
    out_ = advertise<ActuatorState>(context, out, PortRank::kState);
  }

  std::vector<Phase> phases() const override { return {Phase::kControl}; }

  void pre_step(Phase, World& world, const StepInfo& info) override {
    const ActuatorCommand* command = take_due(info);
    if (command != nullptr && accept(world, *command)) to_motors_->write(*command);
    if (out_->wanted() && to_motors_->count() > 0) {
      out_->value.stamp = info.end;
      out_->value.angular_velocities = to_motors_->at(to_motors_->count() - 1).angular_velocities;
      out_->publish();
    }
  }

  void reset() override {
    in_->clear();
    to_motors_->clear();
    next_ = 0;
    refused_ = false;
  }
  void state(StateArchive& archive) override { archive(next_, refused_); }

 private:
  /// Stamps further ahead than this belong to another clock and count as none.
  static constexpr std::int64_t kForeignClockNs = 1'000'000'000;

  bool is_due(const ActuatorCommand& command, const StepInfo& info) const {
    const SimTime latest = delayed_ ? info.begin - info.dt : info.begin;
    return command.stamp.ns == 0 || command.stamp <= latest ||
           command.stamp.ns > info.end.ns + kForeignClockNs;
  }

  /// The latest command that is due and has not been passed on; older ones are dropped.
  const ActuatorCommand* take_due(const StepInfo& info) {
    const ActuatorCommand* due = nullptr;
    for (std::uint64_t i = std::max(next_, in_->oldest()); i < in_->count(); ++i) {
      if (!is_due(in_->at(i), info)) break;
      due = &in_->at(i);
      next_ = i + 1;
    }
    return due;
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

  bool delayed_;
  std::string name_;
  std::uint64_t next_ = 0;
  bool refused_ = false;
  InHandle<ActuatorCommand> in_, to_motors_;
  OutHandle<ActuatorState> out_;
};

}  // namespace

PluginFactory controller_interface_factory() {
  return {
      [](const PluginContext& context) { return std::make_unique<ControllerInterface>(context); },
      {}};
}

}  // namespace trident
