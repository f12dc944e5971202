// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "core/plugins/rate_ticker.h"
#include "drive_parts.h"
#include "trident_sim/plugin_registry.h"
#include "velocity_command.h"

namespace trident::sim {
namespace {

/// libgazebo_ros_planar_move.so: moves a model in the plane as commanded, whatever its wheels do.
/// Walls still stop it, and it still falls: only its velocities along the ground and about the
/// vertical are set, in every step. <commandTopic>, <odometryTopic>, <odometryFrame>,
/// <robotBaseFrame>, <odometryRate> 20, <cmdTimeout> [s] after which it stands (< 0: never).
class PlanarMove : public Plugin {
 public:
  explicit PlanarMove(const PluginContext& context)
      : model_(of(context)),
        ticker_(context.params.number("odometryRate", 20.0, {0.0, 1e9})),
        command_(context, read_command_topic(context.params),
                 context.params.number("cmdTimeout", -1.0)),
        output_(context, read_odometry_names(context, FramePrefix::kTfPrefix), true, true) {
    const Covariance6 covariance = planar_covariance(1e-5, 1e-5, 1e-3);
    output_.set_covariance(covariance, covariance);
  }

  std::vector<Phase> phases() const override { return {Phase::kActuate, Phase::kPost}; }

  void pre_step(Phase, World& world, const StepInfo&) override {
    command_.poll(world);
    const TwistCommand& command = command_.command();
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
  }
  void state(StateArchive& archive) override {
    ticker_.state(archive);
    command_.state(archive);
  }

 private:
  static Model& of(const PluginContext& context) {
    if (context.model == nullptr || context.model->bodies.empty()) {
      throw Error(context.params.owner() + ": belongs in a model that can move");
    }
    return *context.model;
  }
  Model& model_;
  RateTicker ticker_;
  VelocityInput command_;
  OdometryOutput output_;
};

const PluginRegistrar kGazeboRosPlanarMove("libgazebo_ros_planar_move.so", factory_of<PlanarMove>(),
                                           PluginExample{"<odometryRate>100</odometryRate>",
                                                         {},
                                                         {"odometryRate", "cmdTimeout"}});

}  // namespace

}  // namespace trident::sim
