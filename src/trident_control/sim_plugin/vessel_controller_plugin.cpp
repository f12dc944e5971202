// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control_sim/vessel_controller_plugin.h"

#include <algorithm>

#include "port_names.h"
#include "trident_base/error.h"
#include "trident_control/vessel_controller.h"
#include "trident_sim/commands.h"
#include "trident_sim/samples.h"
#include "trident_sim/world.h"

namespace trident::control {
namespace {

std::string file_of(const sim::PluginContext& context, const char* key) {
  const std::string path = context.params.required_text(key);
  std::string file = context.world.resources().find(path);
  if (file.empty()) {
    context.params.refuse(
        key, path, "a file; searched: as given, then " + context.world.resources().searched());
  }
  return file;
}

VesselController load(const sim::PluginContext& context) {
  try {
    return {load_vessel_model(file_of(context, "vessel")),
            load_vessel_control(file_of(context, "controller"))};
  } catch (const ConfigError& error) {
    throw Error(context.params.owner() + ": " + error.what());
  }
}

/// An input of which each value is handed over once.
template <class Sample>
class Inbox {
 public:
  Inbox(sim::PortBoard& board, const std::string& topic)
      : topic_(topic), port_(board, board.subscribe<Sample>(topic)) {}

  template <class Handler>
  void take(const Handler& handler) {
    // The port keeps the newest values only; what it has dropped is skipped.
    for (seen_ = std::max(seen_, port_->oldest()); seen_ < port_->count(); ++seen_) {
      handler(topic_, port_->at(seen_));
    }
  }
  void reset() {
    port_->clear();
    seen_ = 0;
  }
  void state(sim::StateArchive& archive) { archive(seen_); }

 private:
  std::string topic_;
  sim::InHandle<Sample> port_;
  std::uint64_t seen_ = 0;
};

class VesselControllerPlugin : public sim::Plugin {
 public:
  using Kind = VesselCommand::Kind;

  explicit VesselControllerPlugin(const sim::PluginContext& context)
      : VesselControllerPlugin(context, context.params.text("robotNamespace", "")) {}

  ~VesselControllerPlugin() override {
    if (auto* still = world_.ports().find_out<sim::OdometrySample>(odometry_.name)) {
      still->remove_listener();
    }
  }

  std::vector<sim::Phase> phases() const override {
    return {direct_ ? sim::Phase::kPost : sim::Phase::kControl};
  }
  void pre_step(sim::Phase, sim::World&, const sim::StepInfo&) override { update(); }
  void post_step(const sim::World&, const sim::StepInfo&) override { update(); }

  void reset() override {
    controller_.reset();
    odometry_.seen = odometry_.port->count();
    each_inbox([](auto& inbox) { inbox.reset(); });
  }
  void state(sim::StateArchive& archive) override {
    archive(controller_, odometry_.seen, answer_);
    each_inbox([&](auto& inbox) { inbox.state(archive); });
  }

 private:
  VesselControllerPlugin(const sim::PluginContext& context, const std::string& ns)
      : world_(context.world),
        owner_(context.params.owner()),
        direct_(context.world.timing() == sim::LoopTiming::kDirect),
        controller_(load(context)),
        speed_(context.world.ports(), join_namespace(ns, "command/speed")),
        heading_(context.world.ports(), join_namespace(ns, "command/heading")),
        course_(context.world.ports(), join_namespace(ns, "command/course")),
        log_(context.world.ports(), join_namespace(ns, "speed_through_water")),
        velocity_(context.world.ports(), join_namespace(ns, "cmd_vel")),
        path_(context.world.ports(), join_namespace(ns, "command/path")),
        pose_(context.world.ports(), join_namespace(ns, "command/pose")) {
    sim::PortBoard& board = context.world.ports();
    odometry_.name = join_namespace(ns, context.params.text("odometryTopic", "odometry"));
    odometry_.port = board.find_out<sim::OdometrySample>(odometry_.name);
    if (odometry_.port == nullptr) {
      context.params.refuse("odometryTopic", odometry_.name,
                            "the topic of an odometry plugin before it");
    }
    const std::string topic =
        join_namespace(ns, context.params.text("commandTopic", "command/motor_speed"));
    // Subscribing would make the port, so that a misspelled
    // topic would command nobody without an error.
    if (board.find_in<sim::ActuatorCommand>(topic) == nullptr) {
      context.params.refuse("commandTopic", topic,
                            "the <commandTopic> of a vessel's plugin before it");
    }
    command_ = {board, board.subscribe<sim::ActuatorCommand>(topic)};
    odometry_.port->add_listener();
  }

  template <class Action>
  void each_inbox(const Action& action) {
    action(speed_), action(heading_), action(course_), action(log_);
    action(velocity_), action(path_), action(pose_);
  }

  void take_commands() {
    const auto angle = [this](Kind kind) {
      return [this, kind](const std::string& topic, const sim::ScalarSample& sample) {
        VesselCommand command;
        command.kind = kind;
        command.speed = command.angle = sample.value;
        push(topic, {}, command);
      };
    };
    speed_.take(angle(Kind::kSpeed));
    heading_.take(angle(Kind::kHeading));
    course_.take(angle(Kind::kCourse));
    log_.take([this](const std::string&, const sim::ScalarSample& sample) {
      controller_.set_log(world_.time(), sample.value);
    });
    velocity_.take([this](const std::string& topic, const sim::TwistCommand& twist) {
      VesselCommand command;
      command.speed = twist.v_base.x();
      command.rate = twist.w_base.z();
      push(topic, {}, command);
    });
    path_.take([this](const std::string& topic, const sim::PathCommand& path) {
      VesselCommand command;
      command.kind = Kind::kPath;
      for (const Eigen::Vector3d& p : path.p_world) command.waypoints.emplace_back(p.head<2>());
      push(topic, path.stamp, command);
    });
    pose_.take([this](const std::string& topic, const sim::PoseSample& pose) {
      VesselCommand command;
      command.kind = Kind::kStation;
      command.waypoints.emplace_back(pose.T_frame_body.p.head<2>());
      command.angle = yaw_from_quaternion(pose.T_frame_body.R);
      push(topic, pose.stamp, command);
    });
  }

  void push(const std::string& topic, SimTime stamp, const VesselCommand& command) {
    const CommandVerdict verdict = controller_.push(stamp, command);
    if (!verdict.refused.empty()) {
      world_.diagnose({sim::Severity::kError,
                       owner_,
                       topic + " refused",
                       topic + ": " + verdict.refused + "; the last command stays",
                       {}});
    }
    if (!verdict.clamped.empty()) {
      world_.diagnose({sim::Severity::kWarning,
                       owner_,
                       topic + " clamped",
                       topic + ": " + verdict.clamped,
                       {}});
    }
  }

  void update() {
    // Commands come first, so that one of this step is in effect for the state of this step.
    take_commands();
    if (odometry_.port->count() == odometry_.seen) return;
    odometry_.seen = odometry_.port->count();
    const sim::OdometrySample& state = odometry_.port->value;
    if (controller_.update(state.stamp, {state.T_parent_child.p, state.T_parent_child.R,
                                         state.v_child, state.w_child}) != ControlStatus::ok) {
      return;  // a state that is not finite gets no answer, as from the node
    }
    answer_.stamp = state.stamp;
    answer_.angular_velocities.assign(controller_.commands());
    command_->write(answer_);
  }

  /// The states that are answered.
  struct Odometry {
    std::string name;
    sim::OutPort<sim::OdometrySample>* port = nullptr;
    std::uint64_t seen = 0;
  };

  sim::World& world_;
  std::string owner_;
  bool direct_;
  VesselController controller_;
  Inbox<sim::ScalarSample> speed_, heading_, course_, log_;
  Inbox<sim::TwistCommand> velocity_;
  Inbox<sim::PathCommand> path_;
  Inbox<sim::PoseSample> pose_;
  Odometry odometry_;
  sim::InHandle<sim::ActuatorCommand> command_;
  sim::ActuatorCommand answer_;
};

}  // namespace

sim::PluginFactory vessel_controller_factory() { return sim::factory_of<VesselControllerPlugin>(); }

}  // namespace trident::control
