// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "drive_parts.h"
#include "gazebo_ros_plugins.h"

namespace trident {
namespace {

/// libgazebo_ros_planar_move.so: moves a model in the plane as it is told, whatever its wheels do.
/// Walls still stop it, and it still falls: only its velocities along the ground and about the
/// vertical are set, in every step. <commandTopic>, <odometryTopic>, <odometryFrame>,
/// <robotBaseFrame>, <odometryRate> 20, <cmdTimeout> [s] after which it stands (< 0: never).
class PlanarMove : public Plugin {
 public:
  explicit PlanarMove(const PluginContext& context)
      : model_(of(context)),
        ticker_(context.params.number("odometryRate", 20.0, {0.0, 1e9})),
        timeout_s_(context.params.number("cmdTimeout", -1.0)),
        command_(context,
                 scoped_topic(context.params, context.params.text("commandTopic", "cmd_vel"))),
        output_(context, names(context), true, true) {
    const Covariance6 covariance = planar_covariance(1e-5, 1e-5, 1e-3);
    output_.set_covariance(covariance, covariance);
  }

  std::vector<Phase> phases() const override { return {Phase::kActuate, Phase::kPost}; }

  void pre_step(Phase, World& world, const StepInfo& info) override {
    command_.poll(world);
    age_s_ = command_.is_new() ? 0.0 : age_s_ + info.dt_s;
    const bool is_old = timeout_s_ >= 0.0 && age_s_ > timeout_s_;
    const TwistCommand command = is_old ? TwistCommand{} : command_.command();
    const double yaw = SE2::projected(model_.T_world_model()).angle;
    const double c = std::cos(yaw), s = std::sin(yaw);
    const double falling = link_velocity_world(*model_.canonical_link()).z();
    world.set_model_twist(model_,
                          {c * command.v_base.x() - s * command.v_base.y(),
                           s * command.v_base.x() + c * command.v_base.y(), falling},
                          {0.0, 0.0, command.w_base.z()});
  }

  void post_step(const World&, const StepInfo& info) override {
    if (ticker_.tick(info) && output_.wanted()) {
      output_.publish(info.end, base_state_in_world(model_));
    }
  }

  void reset() override {
    ticker_.reset();
    command_.reset();
    age_s_ = 0.0;
  }
  void state(StateArchive& archive) override {
    ticker_.state(archive);
    command_.state(archive);
    archive(age_s_);
  }

 private:
  static Model& of(const PluginContext& context) {
    if (context.model == nullptr || context.model->bodies.empty()) {
      throw Error(context.params.owner() + ": belongs in a model that can move");
    }
    return *context.model;
  }
  static OdometryOutput::Names names(const PluginContext& context) {
    const PluginParams& params = context.params;
    const auto frame = [&](const char* key, const char* fallback) {
      return resolved_frame(context, params.text(key, fallback), FramePrefix::kTfPrefix);
    };
    return {scoped_topic(params, params.text("odometryTopic", "odom")),
            frame("odometryFrame", "odom"), frame("robotBaseFrame", "base_footprint")};
  }

  Model& model_;
  RateTicker ticker_;
  double timeout_s_;
  double age_s_ = 0.0;  ///< of the command
  VelocityInput command_;
  OdometryOutput output_;
};

}  // namespace

PluginFactory planar_move_factory() {
  return {[](const PluginContext& context) { return std::make_unique<PlanarMove>(context); }, {}};
}

}  // namespace trident
