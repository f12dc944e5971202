// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control_sim/lee_plugin.h"

#include <algorithm>
#include <sstream>

#include "port_names.h"
#include "trident_base/error.h"
#include "trident_control_sim/vessel_controller_plugin.h"
#include "trident_sim/samples.h"
#include "trident_sim/world.h"

namespace trident::control {
namespace {

std::vector<std::string> split(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

class LeePlugin : public sim::Plugin {
 public:
  explicit LeePlugin(const sim::PluginContext& context)
      : world_(context.world),
        controller_(load_lee_params(split(context.params.required_text("parameterFiles")))) {
    const std::string ns = context.params.text("robotNamespace", "");
    const auto topic = [&](const char* key, const char* fallback) {
      return join_namespace(ns, context.params.text(key, fallback));
    };
    sim::PortBoard& board = context.world.ports();
    odometry_name_ = topic("odometryTopic", "odometry_sensor1/odometry");
    odometry_ = board.find_out<sim::OdometrySample>(odometry_name_);
    if (odometry_ == nullptr) {
      context.params.refuse("odometryTopic", odometry_name_,
                            "the topic of an odometry plugin before it");
    }
    // The odometry plugin computes samples only while somebody listens.
    odometry_->add_listener();
    command_ = {
        board, board.subscribe<sim::ActuatorCommand>(topic("commandTopic", "command/motor_speed"))};
    trajectory_ = {
        board, board.subscribe<TrajectorySample>(topic("trajectoryTopic", "command/trajectory"))};
    answer_.angular_velocities.size = controller_.rotor_count();
    direct_ = context.world.timing() == sim::LoopTiming::kDirect;
  }

  ~LeePlugin() override {
    if (auto* still = world_.ports().find_out<sim::OdometrySample>(odometry_name_))
      still->remove_listener();
  }

  std::vector<sim::Phase> phases() const override {
    // With direct timing the state of a step is answered as the step ends; with that of RotorS in
    // the next step, after the sensors.
    return {direct_ ? sim::Phase::kPost : sim::Phase::kControl};
  }
  void pre_step(sim::Phase, sim::World&, const sim::StepInfo&) override { update(); }
  void post_step(const sim::World&, const sim::StepInfo&) override { update(); }

  void reset() override {
    setpoints_ = SetpointQueue{};
    trajectory_->clear();
    trajectory_seen_ = 0;
    odometry_seen_ = odometry_->count();
  }

  void state(sim::StateArchive& archive) override {
    archive(setpoints_, odometry_seen_, trajectory_seen_, answer_);
  }

 private:
  void update() {
    // Set-points come first, so that one of this step is in effect for the state of this step.
    trajectory_seen_ = std::max(trajectory_seen_, trajectory_->oldest());
    for (; trajectory_seen_ < trajectory_->count(); ++trajectory_seen_) {
      const TrajectorySample& sample = trajectory_->at(trajectory_seen_);
      if (setpoints_.push(sample.stamp, sample.points) != SetpointResult::accepted) {
        world_.report(sim::Severity::kError, odometry_name_ +
                                                 ": a trajectory was refused (empty, not "
                                                 "finite or not in time order)");
      }
    }
    if (odometry_->count() == odometry_seen_) return;
    odometry_seen_ = odometry_->count();
    const sim::OdometrySample& state = odometry_->value;
    const TrajectoryPoint* reference = setpoints_.advance(state.stamp);
    auto speeds = Span(answer_.angular_velocities.data.data(), controller_.rotor_count());
    if (reference == nullptr) {
      std::fill(speeds.begin(), speeds.end(), 0.0);
    } else if (controller_.compute(
                   {state.T_parent_child.p, state.T_parent_child.R, state.v_child, state.w_child},
                   *reference, speeds) != ControlStatus::ok) {
      return;  // a state that is not finite gets no answer, as from the node
    }
    answer_.stamp = state.stamp;
    command_->write(answer_);
  }

  sim::World& world_;
  LeePositionController controller_;
  SetpointQueue setpoints_;
  std::string odometry_name_;
  sim::OutPort<sim::OdometrySample>* odometry_ = nullptr;
  sim::InHandle<sim::ActuatorCommand> command_;
  sim::InHandle<TrajectorySample> trajectory_;
  std::uint64_t odometry_seen_ = 0, trajectory_seen_ = 0;
  sim::ActuatorCommand answer_;
  bool direct_ = false;
};

}  // namespace

void register_control_plugins(sim::PluginRegistry& registry) {
  registry.add("libtrident_lee_position_controller.so", sim::factory_of<LeePlugin>());
  registry.add("libtrident_vessel_controller.so", vessel_controller_factory());
}

}  // namespace trident::control

extern "C" void trident_register_plugins(trident::sim::PluginRegistry& registry) {
  trident::control::register_control_plugins(registry);
}
