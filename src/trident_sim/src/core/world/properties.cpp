// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <set>

#include "core/physics/physics_engine.h"
#include "core/physics/run_time_changes.h"
#include "trident_base/error.h"
#include "trident_sim/motion_limits.h"
#include "trident_sim/plugin.h"
#include "trident_sim/world/model_set.h"

namespace trident::sim {
namespace {

/// Beyond what is built, and far enough below what a double holds.
constexpr double kHeaviest_kg = 1e12;
constexpr double kTurn = 6.283185307179586;

/// Principal moments instead of the diagonal: products of inertia can make a tensor indefinite.
void validate(const Link& link, const Inertial& inertial) {
  const auto refuse = [&link](const std::string& why) {
    throw Error("link [" + link.name + "]: " + why);
  };
  if (!(inertial.mass_kg > 0.0 && inertial.mass_kg <= kHeaviest_kg)) {
    refuse("mass is " + std::to_string(inertial.mass_kg) + " kg, must be in (0, 1e12]");
  }
  if (!is_within(inertial.T_link_com.p, kFarthestBodyM) ||
      !inertial.T_link_com.R.coeffs().allFinite()) {
    refuse("com is not finite, or beyond 1e7 m");
  }
  if (!inertial.inertia_com.allFinite()) refuse("inertia is not finite");
  const Eigen::Vector3d principal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertial.inertia_com, Eigen::EigenvaluesOnly)
          .eigenvalues();
  if (!(principal.minCoeff() > 0.0 && principal.maxCoeff() <= kHeaviest_kg)) {
    refuse("principal inertias are " + std::to_string(principal.minCoeff()) + " to " +
           std::to_string(principal.maxCoeff()) + " kg m^2, must be in (0, 1e12]");
  }
}

Model* model_of(const std::map<std::string, std::unique_ptr<Model>>& models, const Link& link) {
  for (const auto& [name, model] : models) {
    for (const auto& own : model->links) {
      if (own.get() == &link) return model.get();
    }
  }
  return nullptr;
}

bool holds_world(const Joint& joint) {
  return joint.child->body == nullptr || joint.parent == nullptr || joint.parent->body == nullptr;
}

/// Whether a joint holds one of some bodies in place. A gearbox couples turns; it holds nothing.
bool holds_any(const Joint& joint, const std::set<Body*>& bodies) {
  if (joint.spec.type == JointType::kGearbox) return false;
  return std::any_of(joint.held.begin(), joint.held.end(),
                     [&bodies](Body* body) { return bodies.count(body) > 0; });
}

/// What hangs on `root` with `cut` taken away. Throws Error when that is the world or `other`.
std::set<Body*> hanging_on(const Model& model, const Joint& cut, Body* root, const Body* other) {
  // What is reached over further joints grows until a round adds nothing.
  std::set<Body*> moved{root};
  for (bool grew = true; grew;) {
    grew = false;
    for (const auto& joint : model.joints) {
      const auto& held = joint->held;
      if (joint.get() == &cut || !holds_any(*joint, moved)) continue;
      if (holds_world(*joint) || std::count(held.begin(), held.end(), other) > 0) {
        throw Error("joint [" + cut.spec.name +
                    "] is part of a closed loop, which it cannot be moved without");
      }
      const std::size_t before = moved.size();
      moved.insert(held.begin(), held.end());
      grew = grew || moved.size() > before;
    }
  }
  return moved;
}

/// How `to` moves in the world when its axis moves by `change`.
SE3 motion(const Joint& joint, double change) {
  const JointAxis& axis = joint.axes[0];
  const Eigen::Vector3d along = axis.axis_world();
  if (axis.linear) return {Eigen::Quaterniond::Identity(), change * along};
  // A turn about the axis through the anchor: T = (R, anchor - R anchor).
  const Eigen::Vector3d anchor =
      axis.to != nullptr ? axis.to->pose() * axis.p_to_anchor : axis.p_to_anchor;
  const Eigen::Quaterniond R(Eigen::AngleAxisd(change, along));
  SE3 T{R, anchor - R * anchor};
  if (joint.spec.type == JointType::kScrew) {
    T.p += joint.spec.screw_pitch_m / kTurn * change * along;
  }
  return T;
}

Eigen::Vector3d v_at(const Body* body, const Eigen::Vector3d& p_world) {
  return body == nullptr ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : body->velocity_at(p_world);
}

/// Moves a body, whose motion against `base` moves along.
/// Its motion relative to the base turns along; what the base itself does is added for the new
/// place.
void carry(EngineBody& body, const Body* base, const SE3& T_move) {
  const Eigen::Vector3d p = body.T_world_body.p;
  const Eigen::Vector3d w_base =
      base == nullptr ? Eigen::Vector3d::Zero() : base->angular_velocity();
  const Eigen::Vector3d v = body.v_world - v_at(base, p), w = body.w_world - w_base;
  const SE3 moved = T_move * body.T_world_body;
  body.T_world_body.p = moved.p;
  body.set_orientation(moved.R.normalized());
  body.v_world = body.before.v_world = v_at(base, moved.p) + T_move.R * v;
  body.w_world = body.before.w_world = w_base + T_move.R * w;
}

/// Joints that can be given a position: one axis, or a universal joint's first.
Joint& movable(const Model& model, const std::string& name) {
  Joint* joint = model.find_joint(name);
  if (joint == nullptr) {
    throw Error("joint [" + name + "] is not one of model [" + model.name + "]");
  }
  if (joint->axis_count() == 0 || joint->spec.type == JointType::kGearbox) {
    throw Error("joint [" + name +
                "] has no position that can be set: it is fixed, a ball joint "
                "or a gearbox");
  }
  return *joint;
}

void move_joint(Model& model, Joint& joint, double position) {
  if (joint.is_rotor) {
    joint.rotor_position = position;
    return;
  }
  JointAxis& axis = joint.axes[0];
  const double change = position - joint.position();
  const bool is_to_moved = axis.to != nullptr;
  Body* root = is_to_moved ? axis.to : axis.from;
  const Body* base = is_to_moved ? axis.from : axis.to;
  const SE3 T_to = motion(joint, change);
  const SE3 T_move = is_to_moved ? T_to : T_to.inverse();
  for (Body* body : hanging_on(model, joint, root, base)) carry(engine_body(*body), base, T_move);
  axis.turned = position;
}

/// Refuses a joint of a closed loop.
void require_open_chain(const Model& model, const Joint& joint) {
  if (joint.is_rotor) return;
  const JointAxis& axis = joint.axes[0];
  const bool is_to_moved = axis.to != nullptr;
  hanging_on(model, joint, is_to_moved ? axis.to : axis.from, is_to_moved ? axis.from : axis.to);
}

/// A rotor turns without end.
double within_limits(const Joint& joint, double position) {
  if (joint.is_rotor) return position;
  const AxisSpec& spec = joint.axes[0].spec;
  return std::clamp(position, spec.lower, spec.upper);
}

}  // namespace

/// Bodies of several links are composed again. A new spawn number makes older snapshots unfit,
/// since they hold velocities of other centers of mass.
void ModelSet::set_link_inertial(Link& link, const Inertial& inertial, bool gravity) {
  validate(link, inertial);
  Model& model = *model_of(models_, link);
  const auto at = std::find_if(model.links.begin(), model.links.end(),
                               [&link](const auto& own) { return own.get() == &link; });
  LinkSpec& spec = model.spec.links[static_cast<std::size_t>(at - model.links.begin())];
  spec.inertial = inertial;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    model.links[i]->inertial = model.spec.links[i].inertial;
  }
  spec.gravity = link.gravity = gravity;
  if (link.body == nullptr) return;
  recompose(model, engine_body(*link.body));
  engine_->push_state(model);
  model.spawn_number = ++spawn_count_;  // older snapshots are of other body frames
  ++models_version_;
  for (const auto& plugin : model.plugins) plugin->body_frames_moved();
}

void ModelSet::set_axis_params(Joint& joint, std::size_t axis, const AxisParams& params) {
  trident::sim::set_axis_params(joint, axis, params);
}

/// First all checks, then all moves: an error in the last joint must leave the first where it was.
std::vector<std::string> ModelSet::set_joint_positions(
    Model& model, const std::vector<std::pair<std::string, double>>& positions) {
  std::vector<std::pair<Joint*, double>> targets;
  std::vector<std::string> clamped;
  for (const auto& [name, position] : positions) {
    Joint& joint = movable(model, name);
    if (!(std::abs(position) <= kFarthestBodyM)) {
      throw Error("position of joint [" + name + "] is not finite, or beyond 1e7");
    }
    const double target = within_limits(joint, position);
    if (target != position) clamped.push_back(name);
    require_open_chain(model, joint);
    targets.emplace_back(&joint, target);
  }
  for (const auto& [joint, target] : targets) move_joint(model, *joint, target);
  engine_->push_state(model);
  return clamped;
}

}  // namespace trident::sim
