// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "physics_engine.h"

#include <algorithm>
#include <numeric>

#include "body_sync.h"
#include "free_body.h"
#include "ode_context.h"
#include "rotor_axis.h"

namespace trident::sim {
namespace {

/// As many contacts of two shapes as Gazebo keeps.
constexpr int kMaxContacts = 250;

bool is_constrained(const EngineBody& body) { return body.joint_count > 0 || body.in_contact; }

void pull_down(EngineBody& body, const Eigen::Vector3d& gravity) {
  const Eigen::Vector3d weight = body.composite.weight_kg * gravity;
  body.force += weight;
  // Where links of the body have their gravity switched
  // off, the weight does not act at the center of mass.
  if (!body.composite.p_weight.isZero(0.0))
    body.torque += (body.R_world_body * body.composite.p_weight).cross(weight);
}

}  // namespace

PhysicsEngine::PhysicsEngine(const PhysicsSpec& spec, bool rotor_axes_lag, Report report)
    : report_(std::move(report)), contact_buffer_(1) {
  rotors_.axes_lag = rotor_axes_lag;
  init_ode();
  world_ = dWorldCreate();
  solver_ = std::make_unique<ConstraintSolver>(world_);
  configure(spec);
}

PhysicsEngine::~PhysicsEngine() {
  solver_.reset();
  dWorldDestroy(world_);
}

void PhysicsEngine::configure(const PhysicsSpec& spec) {
  spec_ = spec;
  gravity_ = spec.gravity;
  dWorldSetGravity(world_, 0, 0, 0);  // added per body, because a link may switch it off
  dWorldSetAutoDisableFlag(world_, 0);
  solver_->configure(spec);
  contact_buffer_.resize(static_cast<std::size_t>(std::clamp(spec.max_contacts, 1, kMaxContacts)));
}

PhysicsEngine::StaticGeom PhysicsEngine::as_static(EngineGeom& geom) {
  StaticGeom entry{&geom, dGeomGetClass(geom.id) == dPlaneClass, {}, {}, {}, 0.0};
  if (entry.is_plane) {
    dVector4 plane;
    dGeomPlaneGetParams(geom.id, plane);
    entry.normal = {plane[0], plane[1], plane[2]};
    entry.offset = plane[3];
  } else {
    dReal aabb[6];
    dGeomGetAABB(geom.id, aabb);
    entry.lo = {aabb[0], aabb[2], aabb[4]};
    entry.hi = {aabb[1], aabb[3], aabb[5]};
  }
  return entry;
}

void PhysicsEngine::list_joints(const Model& model) {
  for (const auto& joint : model.joints) {
    if (joint->ode != nullptr) ode_joints_.push_back(joint.get());
    if (joint->is_rotor && joint->child->body != nullptr) rotors_.joints.push_back(joint.get());
  }
}

/// Rotors of one body follow each other.
void PhysicsEngine::list_rotor_carriers() {
  for (std::size_t i = 0; i < rotors_.joints.size(); ++i) {
    EngineBody* body = engine_body(rotors_.joints[i]->child->body);
    if (rotors_.carriers.empty() || rotors_.carriers.back().body != body) {
      rotors_.carriers.push_back({body, i, i});
    }
    rotors_.carriers.back().last = i + 1;
  }
}

void PhysicsEngine::set_models(const std::vector<Model*>& models) {
  const std::vector<EngineBody*> before = std::move(bodies_);
  bodies_.clear();
  ode_joints_.clear();
  rotors_.joints.clear();
  rotors_.carriers.clear();
  // Everything is listed again: the order of the models decides that of the solver's sums.
  statics_.clear();
  reported_contacts_.clear();
  for (Model* model : models) {
    for (const auto& body : model->bodies) bodies_.push_back(engine_body(body.get()));
    list_joints(*model);
    if (model->static_geoms == nullptr) continue;
    for (EngineGeom& geom : model->static_geoms->geoms) statics_.push_back(as_static(geom));
  }
  list_rotor_carriers();
  for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i]->number = i;
  solver_->renumber(before, bodies_);
  centers_.resize(bodies_.size());
  order_.resize(bodies_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
}

void PhysicsEngine::push_state(Model& model) {
  for (const auto& body : model.bodies) push(engine_body(*body));
}

void PhysicsEngine::push_state(Body& body) { push(engine_body(body)); }

void PhysicsEngine::forget_contacts() { solver_->forget(); }

void PhysicsEngine::state(StateArchive& archive) {
  archive(order_);
  solver_->state(archive);
}

void PhysicsEngine::begin_step() {
  for (EngineBody* body : bodies_) {
    body->in_contact = false;
    // A body that diverges in this step returns to here.
    body->before.T_world_body = body->T_world_body;
    body->before.v_world = body->v_world;
    body->before.w_world = body->w_world;
    pull_down(*body, gravity_);
  }
}

/// Returns whether there are others, which are for the solver.
bool PhysicsEngine::integrate_free_bodies(double dt_s) {
  bool any_constrained = false;
  for (EngineBody* body : bodies_) {
    if (is_constrained(*body)) {
      any_constrained = true;
    } else if (!body->frozen) {
      integrate_free_body(*body, dt_s);
    }
  }
  return any_constrained;
}

void PhysicsEngine::end_step() {
  for (EngineBody* body : bodies_) {
    body->force.setZero();
    body->torque.setZero();
    if (is_diverged(*body)) freeze(*body);
  }
}

void PhysicsEngine::step(double dt_s) {
  init_ode();  // of this thread
  // Rotors and gravity load the bodies, contacts decide which of them are free, free ones are
  // integrated here and all others by the solver.
  load_rotors(dt_s);
  begin_step();
  find_contacts(dt_s);
  const bool any_constrained = integrate_free_bodies(dt_s);
  if (any_constrained) solver_->solve(bodies_, ode_joints_, dt_s);
  if (!watched_.empty() || !reported_contacts_.empty()) report_contacts();
  for (Joint* joint : ode_joints_) joint->count_turns();
  advance_rotors(dt_s);
  end_step();
}

void PhysicsEngine::freeze(EngineBody& body) {
  // A frozen one on a joint is still pulled at, and held again.
  if (!body.frozen) {
    report_("body '" + body.name +
            "': its state grows without bound (over 1e5 m/s, 1e4 rad/s or 1e7 m, or not a number); "
            "it stands still from here until a reset");
  }
  body.T_world_body.p = body.before.T_world_body.p;
  body.set_orientation(body.before.T_world_body.R);
  body.v_world.setZero();
  body.w_world.setZero();
  body.frozen = true;
}

void PhysicsEngine::load_rotors(double dt_s) {
  for (const RotorCarrier& carrier : rotors_.carriers) {
    EngineBody& body = *carrier.body;
    body.rotor_momentum.setZero();
    Eigen::Vector3d reaction = Eigen::Vector3d::Zero();
    for (std::size_t i = carrier.first; i < carrier.last; ++i) {
      const Joint& joint = *rotors_.joints[i];
      // Angular momentum of the rotors, for the gyroscopic torque on their carrier.
      body.rotor_momentum += joint.rotor_inertia.axial * joint.rotor_velocity * joint.axis_body;
      if (rotors_.axes_lag) reaction += rotor_axis_reaction(joint, spec_.erp, dt_s);
    }
    if (rotors_.axes_lag) body.torque += body.R_world_body * reaction;
  }
}

void PhysicsEngine::advance_rotors(double dt_s) {
  // Nothing turns a rotor about its axis within a step, so it keeps its rate in space and the
  // carrier's own turning shows in the joint rate; its motor sets the rate again in the next step.
  for (const RotorCarrier& carrier : rotors_.carriers) {
    const EngineBody& body = *carrier.body;
    const Eigen::Vector3d w_body = body.R_world_body.transpose() * body.w_world;
    const Eigen::Vector3d dw_body =
        body.R_world_body.transpose() * (body.w_world - body.before.w_world);
    for (std::size_t i = carrier.first; i < carrier.last; ++i) {
      Joint& joint = *rotors_.joints[i];
      joint.rotor_position += dt_s * joint.rotor_velocity;
      joint.rotor_velocity -= joint.axis_body.dot(dw_body);
    }
    if (!rotors_.axes_lag) continue;
    advance_rotor_axes({&rotors_.joints[carrier.first], carrier.last - carrier.first}, w_body,
                       spec_.erp, dt_s);
  }
}

}  // namespace trident::sim
