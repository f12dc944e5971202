// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Placing models and links by hand, and resets.
#include "core/physics/engine_body.h"
#include "core/physics/physics_engine.h"
#include "trident_base/error.h"
#include "trident_sim/motion_limits.h"
#include "trident_sim/world.h"

namespace trident::sim {
namespace {

/// Puts a body somewhere by hand. The jump is no acceleration: its past moves with it.
void place(EngineBody& body, const SE3& T_world_body, const Eigen::Vector3d& v_world,
           const Eigen::Vector3d& w_world) {
  body.T_world_body.p = T_world_body.p;
  body.set_orientation(T_world_body.R);
  body.v_world = body.before.v_world = v_world;
  body.w_world = body.before.w_world = w_world;
  body.placed = true;
  body.frozen = false;
}

void place_as_at_start(Model& model) {
  for (const auto& joint : model.joints) joint->reset();
  for (const auto& body : model.bodies) {
    place(engine_body(*body), engine_body(*body).T_world_body_initial, Eigen::Vector3d::Zero(),
          Eigen::Vector3d::Zero());
  }
}

}  // namespace

/// Time continues, but samples count from here (StepInfo::sample): noise and rates repeat exactly
/// after every reset.
void World::reset_models() {
  reset_step_ = step_count_;
  reset_loads();
  for (auto& [name, model] : models_) {
    place_as_at_start(*model);
    engine_->push_state(*model);
    for (const auto& plugin : model->plugins) plugin->reset();
  }
  for (const auto& plugin : world_plugins_) plugin->reset();
  engine_->forget_contacts();
  rebuild_schedule();
}

void World::reset() {
  time_ = {};
  step_count_ = 0;
  reset_models();
}

/// All bodies move by one rigid transform, so that joints keep their positions.
void ModelSet::set_model_pose(Model& model, const SE3& T_world_model) {
  if (!is_place(T_world_model)) {
    throw Error("model '" + model.name +
                "': pose is not finite, is beyond 1e7 m or has a zero quaternion");
  }
  if (model.is_static) throw Error("model '" + model.name + "' is static and cannot be moved");
  const SE3 target{T_world_model.R.normalized(), T_world_model.p};
  const SE3 T_move = target * model.T_world_model().inverse();
  for (const auto& body : model.bodies) {
    const SE3 moved = T_move * body->pose();
    place(engine_body(*body), {moved.R.normalized(), moved.p}, T_move.R * body->velocity(),
          T_move.R * body->angular_velocity());
  }
  engine_->push_state(model);
}

/// The twist of a rigid body: each center of mass moves by v + w x r.
void ModelSet::set_model_twist(Model& model, const Eigen::Vector3d& v_world,
                               const Eigen::Vector3d& w_world) {
  if (!is_motion(v_world, w_world)) {
    throw Error("model '" + model.name + "': twist is not finite, or beyond 1e5 m/s or 1e4 rad/s");
  }
  const Eigen::Vector3d p_world = model.T_world_model().p;
  for (const auto& body : model.bodies) {
    const SE3 T = body->pose();
    place(engine_body(*body), T, v_world + w_world.cross(T.p - p_world), w_world);
  }
  engine_->push_state(model);
}

void ModelSet::set_link_state(Link& link, const SE3& T_world_link, const Eigen::Vector3d& v_world,
                              const Eigen::Vector3d& w_world) {
  if (!is_place(T_world_link) || !is_motion(v_world, w_world)) {
    throw Error("link '" + link.name +
                "': state is not finite, is beyond 1e7 m, 1e5 m/s or 1e4 rad/s, or has a zero "
                "quaternion");
  }
  if (link.body == nullptr) throw Error("link '" + link.name + "' is static and cannot be moved");
  const SE3 T = SE3{T_world_link.R.normalized(), T_world_link.p} * link.T_body_link.inverse();
  place(engine_body(*link.body), {T.R.normalized(), T.p},
        v_world + w_world.cross(T.p - T_world_link.p), w_world);
  engine_->push_state(*link.body);
}

}  // namespace trident::sim
