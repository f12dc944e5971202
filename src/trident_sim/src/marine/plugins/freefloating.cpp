// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <sstream>

#include "trident_base/string_util.h"
#include "trident_sim/commands.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/sample_clock.h"
#include "vessel_body.h"

namespace trident::sim {
namespace {

/// One <thruster>: fixed, with its <map> to a wrench at the body's centre of gravity, or steering,
/// the link <name>, which is pushed against its z axis.
struct FreeThruster {
  std::string name;
  double effort_n;
  Link* link;    ///< nullptr: fixed
  Vector6d map;  ///< fixed only
  double command_n = 0.0;
};

Vector6d read_map(const PluginParams& params) {
  const std::string text = params.required_text("map");
  std::istringstream words(text);
  Vector6d map;
  std::string rest;
  for (int i = 0; i < 6; ++i) {
    if (!(words >> map[i])) params.refuse("map", text, "six numbers");
  }
  if (words >> rest) params.refuse("map", text, "six numbers");
  return map;
}

FreeThruster read_thruster(const PluginContext& context, const PluginParams& params,
                           std::size_t number) {
  const Limits effort{0.0, 1e6};
  const bool is_fixed = params.has("map");
  FreeThruster thruster{
      is_fixed ? params.text("name", "thr" + std::to_string(number)) : params.required_text("name"),
      params.number("effort", params.number("effortUnderWater", 100.0, effort), effort), nullptr,
      is_fixed ? read_map(params) : Vector6d(Vector6d::Zero())};
  params.number("effortOverWater", 0.0, effort);  // a propeller stays in the water here
  if (is_fixed) return thruster;
  thruster.link = context.model->find_link(thruster.name);
  if (thruster.link == nullptr || thruster.link->body == nullptr) {
    params.refuse("name", thruster.name, "a link of the model that forces move");
  }
  return thruster;
}

/// libfreefloating_gazebo_control.so, as usv_sim_lsa's boats have it: thrusts [N] by name from
/// <robotNamespace>/thruster_command (JointState; efforts, or positions without them) on
/// the model's thrusters, and <robotNamespace>/state, the pose of the model in the world with its
/// velocities in its own axes. One command scales all thrusters down to the strongest's limit.
class FreeFloatingControl : public Plugin {
 public:
  explicit FreeFloatingControl(const PluginContext& context)
      : owner_(context.params.owner()),
        body_(context.params.has("link") ? &moving_link(context, "link")
                                         : context.model->canonical_link()),
        topic_(in_namespace(context, "thruster_command")),
        command_(subscribe<JointCommand>(context, topic_)),
        state_(advertise<OdometrySample>(context, in_namespace(context, "state"),
                                         PortRank::kOdometry)),
        clock_(context.params.number("updateRate", 0.0, {0.0, 1e6})) {
    const PluginParams& params = context.params;
    if (body_ == nullptr || body_->body == nullptr) {
      params.refuse("link", "", "a link of the model that forces move");
    }
    for (std::size_t number = 1;; ++number) {
      const std::string key = "thruster[" + std::to_string(number) + "]";
      if (!params.has(key)) break;
      const PluginParams own = params.below(key);
      thrusters_.push_back(read_thruster(context, own, thrusters_.size()));
    }
    if (thrusters_.empty()) params.refuse("thruster", "", "at least one");
    params.node("switchService");
    state_->value.parent_frame = "world";
    state_->value.child_frame = body_->name;
  }

  std::vector<Phase> phases() const override { return {Phase::kControl, Phase::kPost}; }

  void pre_step(Phase, World& world, const StepInfo&) override {
    for (seen_ = std::max(seen_, command_->oldest()); seen_ < command_->count(); ++seen_) {
      take(world, command_->at(seen_));
    }
    // One ratio for all, so that saturation keeps the direction of force and moment.
    double ratio = 1.0;
    for (const FreeThruster& thruster : thrusters_) {
      if (thruster.effort_n > 0.0) {
        ratio = std::max(ratio, std::abs(thruster.command_n) / thruster.effort_n);
      }
    }
    for (const FreeThruster& thruster : thrusters_) push(thruster, thruster.command_n / ratio);
  }

  void post_step(const World&, const StepInfo& info) override {
    if (!clock_.is_due(info) || !state_->wanted()) return;
    OdometrySample& value = state_->value;
    value.stamp = info.end;
    value.T_parent_child = body_->T_world_link();
    const Eigen::Quaterniond R = value.T_parent_child.R.conjugate();
    value.v_child = R * link_velocity_world(*body_);
    value.w_child = R * body_->w_world();
    state_->publish();
  }

  void reset() override {
    command_->clear();
    seen_ = 0;
    for (FreeThruster& thruster : thrusters_) thruster.command_n = 0.0;
  }
  void state(StateArchive& archive) override {
    archive(seen_);
    for (FreeThruster& thruster : thrusters_) archive(thruster.command_n);
  }

 private:
  /// Below the namespace, or, as upstream, below the model's name where none is given.
  static std::string in_namespace(const PluginContext& context, const std::string& topic) {
    const bool has_one = !context.params.text("robotNamespace", "").empty();
    return scoped_topic(context.params, has_one ? topic : context.model->name + "/" + topic);
  }

  void take(World& world, const JointCommand& command) {
    const std::vector<double>& values =
        command.efforts.empty() ? command.positions : command.efforts;
    if (values.size() != command.names.size()) {
      return refuse(world, std::to_string(command.names.size()) + " names with " +
                               std::to_string(values.size()) + " values");
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto thruster =
          std::find_if(thrusters_.begin(), thrusters_.end(),
                       [&](const FreeThruster& one) { return one.name == command.names[i]; });
      if (thruster == thrusters_.end()) {
        refuse(world, "'" + command.names[i] + "', which is no thruster,");
      } else if (!std::isfinite(values[i])) {
        refuse(world, number_text(values[i]) + " N for '" + thruster->name + "'");
      } else {
        thruster->command_n = values[i];
      }
    }
  }

  void refuse(World& world, const std::string& what) const {
    world.diagnose(
        {Severity::kError,
         owner_,
         "thruster command refused",
         topic_ + ": " + what + " is refused; legal is one finite value [N] per thruster",
         {}});
  }

  void push(const FreeThruster& thruster, double force_n) const {
    if (thruster.link != nullptr) {
      const SE3 T = thruster.link->T_world_link();
      const Eigen::Vector3d force = T.R * Eigen::Vector3d(0.0, 0.0, -force_n);
      thruster.link->body->add_force_at(force, T * thruster.link->inertial.T_link_com.p);
      return;
    }
    const Eigen::Quaterniond R = body_->T_world_link().R;
    const Vector6d wrench = force_n * thruster.map;
    body_->body->apply_force(R * Eigen::Vector3d(wrench.head<3>()));
    body_->body->apply_torque(R * Eigen::Vector3d(wrench.tail<3>()));
  }

  std::string owner_;
  Link* body_;
  std::string topic_;
  InHandle<JointCommand> command_;
  OutHandle<OdometrySample> state_;
  SampleClock clock_;
  std::vector<FreeThruster> thrusters_;
  std::uint64_t seen_ = 0;
};

const PluginRegistrar kFreefloatingGazeboControl("libfreefloating_gazebo_control.so",
                                                 factory_of<FreeFloatingControl>());

}  // namespace

}  // namespace trident::sim
