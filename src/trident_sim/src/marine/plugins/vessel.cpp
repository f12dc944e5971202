// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/plugins/stamped_commands.h"
#include "drive_input.h"
#include "marine_files.h"
#include "trident_sim/plugin_registry.h"
#include "vessel_actuators.h"
#include "vessel_body.h"

namespace trident::sim {
namespace {

VesselParams read_vessel(const PluginContext& context) {
  const std::string path = context.params.required_text("vessel");
  const std::string file = existing_file(context, "vessel", path);
  try {
    return load_vessel(file);
  } catch (const ConfigError& error) {
    throw Error(context.params.owner() + ": <vessel>: " + error.what());
  }
}

/// libtrident_vessel.so: the vessel of the file <vessel> (config/vessels) on the link <bodyName>,
/// whose inertial must be the file's within 1 %. CO, amidships in the design waterline, lies at
/// <xyzOffset> (0 0 0) in the link, whose axes are the body's. With <driveTopic> thrusters named
/// left and right take heron_msgs/Drive there, too. It takes commands on the topics of
/// ThrusterOnTopics and RudderOnTopic; a thruster without any for <cmdTimeout> s stops (0: never).
/// With a <commandTopic> it takes all commands at once in their place, in lockstep: thrusters as in
/// the file, then angles of those that turn, then rudders.
class Vessel : public Plugin, public Floating {
 public:
  explicit Vessel(const PluginContext& context)
      : Vessel(context, moving_link(context, "bodyName"), read_vessel(context)) {}

  std::vector<Phase> phases() const override { return {Phase::kActuate}; }

  void pre_step(Phase, World& world, const StepInfo& info) override {
    // The state at the beginning of the step; actuators that the flow drives, as rudders, need it.
    const Afloat now = body_.sense(world, info);
    if (commands_) take_commands(world, info);
    Vector6d tau = Vector6d::Zero();
    if (drive_) take_drive(world, info);
    for (ThrusterOnTopics& thruster : thrusters_) {
      thruster.step(world, info);
      tau += thruster.thruster().wrench();
      thruster.publish(info.end);
    }
    for (RudderOnTopic& rudder : rudders_) {
      rudder.step(world, info);
      tau += rudder.rudder().wrench(now.nu_r(), water_density_);
    }
    body_.push(world, info, now, tau);
  }

  void body_frames_moved() override { body_.body_frames_moved(); }
  void check_afloat(const Sea& sea) const override { body_.check_afloat(sea); }

  void reset() override {
    body_.reset();
    if (commands_) commands_->reset();
    if (drive_) drive_->reset();
    for (ThrusterOnTopics& thruster : thrusters_) thruster.reset();
    for (RudderOnTopic& rudder : rudders_) rudder.reset();
  }

  void state(StateArchive& archive) override {
    body_.state(archive);
    if (commands_) commands_->state(archive);
    if (drive_) drive_->state(archive);
    for (ThrusterOnTopics& thruster : thrusters_) thruster.state(archive);
    for (RudderOnTopic& rudder : rudders_) rudder.state(archive);
  }

 private:
  Vessel(const PluginContext& context, Link& link, const VesselParams& vessel)
      : owner_(context.params.owner()),
        water_density_(vessel.water_density),
        body_(context, link, vessel, place(context.params)) {
    body_.check_inertial();
    const double timeout_s = context.params.number("cmdTimeout", 0.0, {0.0, 1e6});
    const std::string given = context.params.text("commandTopic", "");
    if (!given.empty()) {
      topic_ = scoped_topic(context.params, given);
      commands_.emplace(context, topic_);
    }
    for (const ThrusterParams& thruster : vessel.thrusters) {
      thrusters_.emplace_back(context, thruster, timeout_s, topic_);
    }
    for (const RudderParams& rudder : vessel.rudders) {
      rudders_.emplace_back(context, rudder, topic_);
    }
    open_drive(context);
  }

  std::size_t channels() const {
    const auto turning = std::count_if(thrusters_.begin(), thrusters_.end(),
                                       [](const ThrusterOnTopics& t) { return t.turns(); });
    return thrusters_.size() + static_cast<std::size_t>(turning) + rudders_.size();
  }

  void take_commands(World& world, const StepInfo& info) {
    const ActuatorCommand* const command = commands_->take_due(info);
    if (command == nullptr) return;
    const auto values = command->angular_velocities.view();
    if (values.size() != channels()) {
      refuse_count(world, values.size());
      return;
    }
    // The order of the channels is that of ThrustAllocation::topics().
    const double* next = values.begin();
    for (ThrusterOnTopics& thruster : thrusters_) thruster.command(world, info, *next++);
    for (ThrusterOnTopics& thruster : thrusters_) {
      if (thruster.turns()) thruster.command_angle(world, *next++);
    }
    for (RudderOnTopic& rudder : rudders_) rudder.command(world, *next++);
  }

  void refuse_count(World& world, std::size_t count) const {
    const std::string given = std::to_string(count), legal = std::to_string(channels());
    world.diagnose({Severity::kError,
                    owner_,
                    "number of commands refused",
                    topic_ + ": " + given + " commands, legal is " + legal +
                        " (thrusters, angles of those that turn, rudders); the last ones stay",
                    {{"value", given}, {"legal", legal}}});
  }

  void open_drive(const PluginContext& context) {
    const std::string topic = context.params.text("driveTopic", "");
    if (topic.empty()) return;
    if (find_thruster("left") == nullptr || find_thruster("right") == nullptr) {
      context.params.refuse("driveTopic", topic, "a vessel with thrusters named left and right");
    }
    drive_.emplace(context, scoped_topic(context.params, topic));
  }

  ThrusterOnTopics* find_thruster(const std::string& name) {
    for (ThrusterOnTopics& thruster : thrusters_) {
      if (thruster.thruster().params().name == name) return &thruster;
    }
    return nullptr;
  }

  void take_drive(World& world, const StepInfo& info) {
    const auto command = drive_->take(world);
    if (!command) return;
    find_thruster("left")->command_part(command->left, info);
    find_thruster("right")->command_part(command->right, info);
  }

  static VesselBody::Place place(const PluginParams& params) {
    VesselBody::Place place;
    place.T_link_co.p = params.vector3("xyzOffset", Eigen::Vector3d::Zero());
    return place;
  }

  std::string owner_, topic_;
  double water_density_;
  VesselBody body_;
  std::optional<StampedCommands> commands_;
  std::vector<ThrusterOnTopics> thrusters_;
  std::vector<RudderOnTopic> rudders_;
  std::optional<DriveInput> drive_;
};

const PluginRegistrar kTridentVessel("libtrident_vessel.so", factory_of<Vessel>());

}  // namespace

}  // namespace trident::sim
