// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "actuator_input.h"
#include "core/plugins/joint_states.h"
#include "marine/vessel/thruster.h"
#include "trident_base/angle.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/sample_clock.h"
#include "vessel_body.h"

namespace trident::sim {
namespace {

/// VRX' elements of a `<thruster>`.
ThrusterParams read_usv_thruster(const PluginParams& params) {
  ThrusterParams thruster;
  thruster.name = params.required_text("linkName");
  const int mapping = params.integer("mappingType", 0, {0.0, 1.0});
  thruster.mapping = mapping == 0 ? ThrustMapping::kLinear : ThrustMapping::kGlf;
  thruster.max_command = params.number("maxCmd", 1.0, {1e-6, 1e6});
  thruster.min_command = -thruster.max_command;
  thruster.max_force_forward = params.number("maxForceFwd", 250.0, {0.0, 1e6});
  thruster.max_force_reverse = -params.number("maxForceRev", -100.0, {-1e6, 0.0});
  params.required_text("enableAngle");
  const double max_angle = params.number("maxAngle", 0.5 * kPi, {1e-6, kPi});
  thruster.max_angle = params.flag("enableAngle", false) ? max_angle : 0.0;
  return thruster;
}

/// Holds an engine's joint at an angle by VRX' gains, for as long as it lives.
class EngineDrive {
 public:
  /// Throws Error for a joint that cannot be driven.
  EngineDrive(World& world, Joint& joint) : world_(world), joint_(joint) {
    DriveSpec spec;
    // VRX' defaults [N m/rad, N m s/rad].
    spec.gains.p = 300.0;
    spec.gains.d = 20.0;
    world.add_drive(joint, spec);
  }
  ~EngineDrive() { world_.remove_drive(joint_); }
  EngineDrive(const EngineDrive&) = delete;
  EngineDrive& operator=(const EngineDrive&) = delete;

  /// Looked up each time, because others may replace it or take it away.
  void turn_to(double angle_rad) {
    if (JointDrive* const drive = world_.find_drive(joint_)) drive->set_target(angle_rad);
  }

 private:
  World& world_;
  Joint& joint_;
};

/// A thruster of VRX: pushes its link along the link's x axis, and turns its engine's joint.
class UsvThruster {
 public:
  /// `context.params` are those of the plugin, `params` those of the element.
  UsvThruster(const PluginContext& context, const PluginParams& params, double timeout_s)
      : UsvThruster(context, PluginContext{context.world, context.model, params, context.name},
                    read_usv_thruster(params), timeout_s) {}

  void step(World& world, const StepInfo& info) {
    if (const auto command = command_.take(world)) {
      thruster_.command(*command);
      commanded_ = info.begin;
    } else if (timeout_s_ > 0.0 && (info.begin - commanded_).seconds() > timeout_s_) {
      thruster_.command(0.0);
    }
    thruster_.step(info.dt_s);
    if (angle_) {
      if (const auto angle = angle_->take(world)) drive_->turn_to(*angle);
    }
    const SE3 T_world_link = link_->T_world_link();
    const Eigen::Vector3d force =
        thruster_.thrust_n() * (T_world_link.R * Eigen::Vector3d::UnitX());
    link_->body->add_force_at(force, T_world_link.p);
    spin_propeller();
  }

  Joint& engine() const { return *engine_; }
  Joint& propeller() const { return *propeller_; }

  void reset() {
    thruster_.reset();
    command_.reset();
    if (angle_) angle_->reset();
    commanded_ = {};
  }
  void state(StateArchive& archive) {
    thruster_.state(archive);
    command_.state(archive);
    if (angle_) angle_->state(archive);
    archive(commanded_);
  }

 private:
  UsvThruster(const PluginContext& context, const PluginContext& own,
              const ThrusterParams& thruster, double timeout_s)
      : link_(&moving_link(own, "linkName")),
        engine_(&required_joint(own, "engineJointName")),
        propeller_(&required_joint(own, "propJointName")),
        thruster_(thruster),
        timeout_s_(timeout_s),
        command_(context, scoped_topic(context.params, own.params.required_text("cmdTopic")),
                 "command of thruster '" + thruster.name + "'", "",
                 {thruster.min_command, thruster.max_command},
                 ActuatorInput::Source::kSingleTopic) {
    const std::string angle_topic =
        scoped_topic(context.params, own.params.required_text("angleTopic"));
    if (thruster.max_angle > 0.0) {
      angle_.emplace(context, angle_topic, "angle of thruster '" + thruster.name + "'", " rad",
                     Limits{-thruster.max_angle, thruster.max_angle},
                     ActuatorInput::Source::kSingleTopic);
    }
    hold_engine(own);
  }

  /// As VRX spins it: with up to 2 N m, from a tenth of the command on. It is only looked at, so
  /// that one whose joint has no damping is not accelerated for ever.
  void spin_propeller() {
    constexpr double kMinPart = 0.1, kTorque = 2.0, kFastest = 100.0;
    const double part = thruster_.command_value() / thruster_.params().max_command;
    if (propeller_->axis_count() == 0 || std::abs(part) <= kMinPart) return;
    const double rate = propeller_->velocity();
    if (std::abs(rate) > kFastest && rate * part > 0.0) return;
    propeller_->add_effort(kTorque * part);
  }

  /// A fixed engine needs nothing unless it is to turn.
  void hold_engine(const PluginContext& own) {
    if (!angle_ && engine_->axis_count() == 0) return;
    try {
      drive_ = std::make_unique<EngineDrive>(own.world, *engine_);
    } catch (const Error& error) {
      throw Error(own.params.owner() + ": <engineJointName>: " + error.what());
    }
  }

  Link* link_;
  Joint *engine_, *propeller_;
  std::unique_ptr<EngineDrive> drive_;
  Thruster thruster_;
  double timeout_s_;
  ActuatorInput command_;
  std::optional<ActuatorInput> angle_;
  SimTime commanded_;
};

/// libusv_gazebo_thrust_plugin.so: VRX' thrusters under VRX' elements and defaults, on the topics
/// that they name, and <robotNamespace>/joint_states of their joints, propellers among them.
/// What the thrusters push is on the bodies before libusv_gazebo_dynamics_plugin.so looks.
class UsvThrust : public Plugin {
 public:
  explicit UsvThrust(const PluginContext& context)
      : clock_(context.params.number("publisherRate", 100.0, {1e-3, 1e4})) {
    const PluginParams& params = context.params;
    const double timeout_s = params.number("cmdTimeout", 1.0, {0.0, 1e6});
    for (std::size_t number = 1;; ++number) {
      const std::string key = "thruster[" + std::to_string(number) + "]";
      if (!params.has(key)) break;
      const PluginParams own = params.below(key);
      thrusters_.emplace_back(context, own, timeout_s);
    }
    if (thrusters_.empty()) params.refuse("thruster", "", "at least one");
    std::vector<Joint*> joints;
    for (const UsvThruster& thruster : thrusters_) {
      joints.push_back(&thruster.engine());
      joints.push_back(&thruster.propeller());
    }
    joints_.emplace(context, scoped_topic(params, "joint_states"), joints);
  }
  std::vector<Phase> phases() const override { return {Phase::kControl, Phase::kPost}; }

  void pre_step(Phase, World& world, const StepInfo& info) override {
    for (UsvThruster& thruster : thrusters_) thruster.step(world, info);
  }

  void post_step(const World& world, const StepInfo& info) override {
    if (clock_.is_due(info)) joints_->publish(world, info.end);
  }

  void reset() override {
    for (UsvThruster& thruster : thrusters_) thruster.reset();
  }
  void state(StateArchive& archive) override {
    for (UsvThruster& thruster : thrusters_) thruster.state(archive);
  }

 private:
  SampleClock clock_;
  std::vector<UsvThruster> thrusters_;
  std::optional<JointStates> joints_;
};

const PluginRegistrar kUsvGazeboThrustPlugin("libusv_gazebo_thrust_plugin.so",
                                             factory_of<UsvThrust>());

}  // namespace

}  // namespace trident::sim
