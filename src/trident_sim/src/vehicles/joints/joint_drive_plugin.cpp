// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "core/plugins/plugin_util.h"
#include "trident_sim/motion_limits.h"
#include "trident_sim/plugin_registry.h"

namespace trident::sim {
namespace {

DriveMode read_mode(const PluginParams& params) {
  const std::string mode = params.required_text("mode");
  if (mode == "effort") return DriveMode::kEffort;
  if (mode == "velocity") return DriveMode::kVelocity;
  if (mode == "position") return DriveMode::kPosition;
  params.refuse("mode", mode, "effort, velocity or position");
}

DriveSpec read_drive(const PluginParams& params) {
  const Limits not_negative{0.0, 1e12};
  DriveSpec spec;
  spec.mode = read_mode(params);
  spec.target = params.number("target", 0.0);
  spec.gains.p = params.number("p", 0.0);
  spec.gains.i = params.number("i", 0.0);
  spec.gains.d = params.number("d", 0.0);
  spec.gains.integral_limit = params.number("integralLimit", 1e12, not_negative);
  spec.gains.output_limit = params.number("effortLimit", 1e12, not_negative);
  return spec;
}

/// A drive of one axis of a joint that is commanded through a port.
///
/// <jointName>; <axis> 0 or 1; <mode> effort, velocity or position; <target> at first; gains <p>,
/// <i>, <d>; <integralLimit> and <effortLimit> [N m] or [N]; <commandTopic> for targets
/// (ScalarSample; "<jointName>/command"); <stateTopic> for what is driven: position, velocity or
/// effort ("<jointName>/state").
class JointDrivePlugin : public Plugin {
 public:
  explicit JointDrivePlugin(const PluginContext& context)
      : world_(context.world), joint_(required_joint(context, "jointName")) {
    const PluginParams& params = context.params;
    axis_ = static_cast<std::size_t>(params.integer("axis", 0, {0, 1}));
    name_ = params.owner();
    const std::string& joint = joint_.spec.name;
    command_ = subscribe<ScalarSample>(
        context, scoped_topic(params, params.text("commandTopic", joint + "/command")));
    state_ = advertise<ScalarSample>(
        context, scoped_topic(params, params.text("stateTopic", joint + "/state")),
        PortRank::kState);
    try {
      const DriveSpec spec = read_drive(params);
      mode_ = spec.mode;
      world_.add_drive(joint_, spec, axis_);
    } catch (const Error& error) {
      throw Error(name_ + ": " + error.what());
    }
  }
  ~JointDrivePlugin() override { world_.remove_drive(joint_, axis_); }

  std::vector<Phase> phases() const override { return {Phase::kControl, Phase::kPost}; }

  void pre_step(Phase, World&, const StepInfo&) override {
    if (command_->count() == seen_) return;
    seen_ = command_->count();
    const double target = command_->at(seen_ - 1).value;
    const bool is_usable = std::abs(target) <= kStrongest;
    if (is_usable) {
      if (JointDrive* own = drive()) own->set_target(target);
    } else if (!refused_) {
      world_.report(Severity::kError, name_ + ": target is " + std::to_string(target) +
                                          ", must be finite, up to 1e15; it keeps its last one");
    }
    refused_ = !is_usable;
  }

  void post_step(const World&, const StepInfo& info) override {
    if (!state_->wanted()) return;
    state_->value = {info.end, measured()};
    state_->publish();
  }

  void reset() override {
    command_->clear();
    seen_ = 0;
    refused_ = false;
  }
  void state(StateArchive& archive) override { archive(seen_, refused_); }

 private:
  /// Looked up each time, because others may replace it or take it away.
  JointDrive* drive() const { return world_.find_drive(joint_, axis_); }

  double measured() const {
    switch (mode_) {
      case DriveMode::kEffort:
        return drive() != nullptr ? drive()->effort() : 0.0;
      case DriveMode::kVelocity:
        return joint_.velocity(axis_);
      case DriveMode::kPosition:
        break;
    }
    return joint_.position(axis_);
  }

  World& world_;
  Joint& joint_;
  std::size_t axis_ = 0;
  std::string name_;
  DriveMode mode_ = DriveMode::kPosition;
  std::uint64_t seen_ = 0;
  bool refused_ = false;
  InHandle<ScalarSample> command_;
  OutHandle<ScalarSample> state_;
};

const PluginRegistrar kTridentJointDrive(
    "libtrident_joint_drive.so", factory_of<JointDrivePlugin>(),
    PluginExample{
        "<jointName>rotor_1_joint</jointName><mode>position</mode><target>0.3</target><p>2e-3</p>"
        "<i>1e-3</i><d>1e-4</d>",
        {"jointName", "mode"},
        {"axis", "target", "p", "i", "d", "integralLimit", "effortLimit"}});

}  // namespace

}  // namespace trident::sim
