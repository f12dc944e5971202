// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "physics_engine.h"

#include <algorithm>
#include <numeric>

#include "body_sync.h"
#include "free_body.h"
#include "ode_context.h"
#include "ode_joint.h"
#include "rotor_axis.h"

namespace trident {
namespace {

/// As many contacts of two shapes as Gazebo keeps.
constexpr int kMaxContacts = 250;

constexpr int kRowsPerJoint = 6;

/// What ODE takes by itself for every constraint. Without any the exact solver has no solution for
/// joints in a closed loop, and ODE ends the process.
constexpr double kLeastJointCfm = 1e-10;

double cfm_of(const PhysicsSpec& spec, bool has_joints) {
  return has_joints ? std::max(spec.cfm, kLeastJointCfm) : spec.cfm;
}

/// Of an island that the exact solver fails on; few enough rows for these to be quick.
constexpr int kFallbackIterations = 500;

bool is_constrained(const Body& body) { return body.joint_count > 0 || body.in_contact; }

void pull_down(Body& body, const Eigen::Vector3d& gravity) {
  const Eigen::Vector3d weight = body.weight_kg * gravity;
  body.force += weight;
  if (!body.p_weight.isZero(0.0)) body.torque += (body.R_world_body * body.p_weight).cross(weight);
}

/// Accelerations that nothing survives [m/s^2], [rad/s^2]. ODE ends the program when a rotation
/// overflows; below these it does not, and the body is frozen after the step.
constexpr double kDeadlyAcceleration = 1e14;

Eigen::Vector3d bounded(const Eigen::Vector3d& v, double limit) {
  if (!v.allFinite()) return Eigen::Vector3d::Constant(limit);
  return v.cwiseMax(-limit).cwiseMin(limit);
}

/// Hands the forces of this step to ODE.
void load(const Body& body) {
  const double smallest_inertia = body.inertia.diagonal().minCoeff();
  const Eigen::Vector3d force = bounded(body.force, kDeadlyAcceleration * body.mass_kg);
  const Eigen::Vector3d torque =
      bounded(body.torque + gyroscopic_torque(body), kDeadlyAcceleration * smallest_inertia);
  dBodySetForce(body.ode, force.x(), force.y(), force.z());
  dBodySetTorque(body.ode, torque.x(), torque.y(), torque.z());
}

void apply_efforts(Joint& joint, double dt_s) {
  for (std::size_t i = 0; i < joint.axis_count(); ++i) {
    JointAxis& axis = joint.axes[i];
    // Damping may stop a joint within a step but not turn it round, and a spring may bring it to
    // its reference but not beyond, or they would feed on themselves.
    const double damping = std::min(axis.damping, axis.inertia / dt_s);
    const double stiffness = std::min(axis.spec.spring_stiffness, axis.inertia / (dt_s * dt_s));
    double effort = std::clamp(axis.force, -axis.spec.effort, axis.spec.effort);
    effort -= damping * joint.velocity(i);
    if (stiffness > 0.0) effort += stiffness * (axis.spec.spring_reference - joint.position(i));
    axis.push(effort);
    axis.force = 0.0;
  }
}

}  // namespace

PhysicsEngine::PhysicsEngine(const PhysicsSpec& spec, bool rotor_axes_lag, Report report)
    : report_(std::move(report)), rotor_axes_lag_(rotor_axes_lag), contact_buffer_(1) {
  init_ode();
  world_ = dWorldCreate();
  contacts_ = dJointGroupCreate(0);
  configure(spec);
}

PhysicsEngine::~PhysicsEngine() {
  dJointGroupDestroy(contacts_);
  dWorldDestroy(world_);
}

void PhysicsEngine::configure(const PhysicsSpec& spec) {
  spec_ = spec;
  gravity_ = spec.gravity;
  dWorldSetGravity(world_, 0, 0, 0);  // added per body, because a link may switch it off
  dWorldSetERP(world_, spec.erp);
  dWorldSetCFM(world_, cfm_of(spec, !ode_joints_.empty()));
  dWorldSetContactSurfaceLayer(world_, spec.contact_surface_layer);
  dWorldSetContactMaxCorrectingVel(world_, spec.contact_max_correcting_vel);
  dWorldSetQuickStepW(world_, spec.sor);
  dWorldSetAutoDisableFlag(world_, 0);
  contact_buffer_.resize(static_cast<std::size_t>(std::clamp(spec.max_contacts, 1, kMaxContacts)));
}

void PhysicsEngine::set_models(const std::vector<Model*>& models) {
  bodies_.clear();
  ode_joints_.clear();
  spun_joints_.clear();
  spun_carriers_.clear();
  statics_.clear();
  told_.clear();
  for (Model* model : models) {
    for (const auto& body : model->bodies) bodies_.push_back(body.get());
    for (const auto& joint : model->joints) {
      if (joint->ode != nullptr) ode_joints_.push_back(joint.get());
      if (joint->spun && joint->child->body != nullptr) spun_joints_.push_back(joint.get());
    }
    for (Geom& geom : model->static_geoms) {
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
      statics_.push_back(entry);
    }
  }
  for (std::size_t i = 0; i < spun_joints_.size(); ++i) {
    Body* body = spun_joints_[i]->child->body;
    if (spun_carriers_.empty() || spun_carriers_.back().body != body) {
      spun_carriers_.push_back({body, i, i});
    }
    spun_carriers_.back().last = i + 1;
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i]->number = i;
  centres_.resize(bodies_.size());
  order_.resize(bodies_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  dWorldSetCFM(world_, cfm_of(spec_, !ode_joints_.empty()));
}

void PhysicsEngine::push_state(Model& model) {
  for (const auto& body : model.bodies) push(*body);
}

void PhysicsEngine::push_state(Body& body) { push(body); }

void PhysicsEngine::step(double dt_s) {
  load_rotors(dt_s);
  for (Body* body : bodies_) {
    body->in_contact = false;
    body->T_before = body->T_world_body;
    body->v_before = body->v_world;
    body->w_before = body->w_world;
    pull_down(*body, gravity_);
  }
  find_contacts(dt_s);
  bool constrained = false;
  for (Body* body : bodies_) {
    if (is_constrained(*body)) {
      constrained = true;
    } else if (!body->frozen) {
      integrate_free_body(*body, dt_s);
    }
  }
  if (constrained) solve_constrained(dt_s);
  if (watched_count_ > 0 || !told_.empty()) tell_contacts();
  for (Joint* joint : ode_joints_) joint->count_turns();
  advance_rotors(dt_s);
  for (Body* body : bodies_) {
    body->force.setZero();
    body->torque.setZero();
    if (is_diverged(*body)) freeze(*body);
  }
}

void PhysicsEngine::freeze(Body& body) {
  // A frozen one on a joint is still pulled at, and held again.
  if (!body.frozen) {
    report_("body '" + body.name +
            "': its state grows without bound (over 1e5 m/s, 1e4 rad/s or 1e7 m, or not a number); "
            "it stands still from here until a reset");
  }
  body.T_world_body.p = body.T_before.p;
  body.set_orientation(body.T_before.R);
  body.v_world.setZero();
  body.w_world.setZero();
  body.frozen = true;
}

void PhysicsEngine::solve_constrained(double dt_s) {
  for (const Joint* joint : ode_joints_) {
    const std::size_t first = joint->held.front()->number;
    islands_.add_rows(first, kRowsPerJoint);
    for (const Body* body : joint->held) islands_.join(first, body->number);
  }
  bool any_small = false, any_large = false;
  for (Body* body : bodies_) {
    if (!is_constrained(*body)) continue;
    push(*body);
    (is_large_island(*body) ? any_large : any_small) = true;
  }
  for (Joint* joint : ode_joints_) prepare_ode_joint(*joint, spec_.erp, dt_s);
  if (any_small) solve_islands(false, dt_s);
  if (any_large) solve_islands(true, dt_s);
}

bool PhysicsEngine::is_large_island(const Body& body) {
  return spec_.solver == "quick" && islands_.rows_of_island(body.number) > spec_.exact_solver_rows;
}

void PhysicsEngine::solve_islands(bool large, double dt_s) {
  for (Joint* joint : ode_joints_) {
    if (is_large_island(*joint->held.front()) == large) apply_efforts(*joint, dt_s);
  }
  for (Body* body : bodies_) {
    if (is_constrained(*body) && is_large_island(*body) == large) load(*body);
  }
  // ODE goes through an island from its first enabled body on and wakes the others: enabling the
  // one of the first name makes the order of rows, hence rounding, independent of who came first.
  for (Body* body : bodies_) {
    if (!is_constrained(*body) || is_large_island(*body) != large) continue;
    if (!islands_.is_first_of_island(body->number)) continue;
    dBodyEnable(body->ode);
    if (large) solve_iteratively(spec_.iterations, dt_s);
  }
  if (!large && !solve_exactly(dt_s)) solve_one_by_one(dt_s);
  for (Body* body : bodies_) {
    if (!is_constrained(*body) || is_large_island(*body) != large) continue;
    pull(*body);
    apply_velocity_decay(*body, dt_s);
    dBodyDisable(body->ode);
  }
}

void PhysicsEngine::solve_iteratively(int iterations, double dt_s) {
  dWorldSetQuickStepNumIterations(world_, iterations);
  dRandSetSeed(0);  // the iterative solver shuffles its rows: the same way in every step
  dWorldQuickStep(world_, dt_s);
  for (Body* body : bodies_) dBodyDisable(body->ode);  // the next island is solved alone
}

bool PhysicsEngine::solve_exactly(double dt_s) {
  const std::uint64_t messages = ode_message_count();
  dWorldStep(world_, dt_s);
  return ode_message_count() == messages;
}

/// The exact solver may fail on a pile in the moment in which a contact opens, and then leaves out
/// rows: a body falls freely for a step. The step is done again, the islands that fail with the
/// other solver, the others to the same result.
void PhysicsEngine::solve_one_by_one(double dt_s) {
  const auto is_small = [this](const Body& body) {
    return is_constrained(body) && !is_large_island(body);
  };
  for (Body* body : bodies_) {
    if (is_small(*body)) put_back(*body);
  }
  for (std::size_t first = 0; first < bodies_.size(); ++first) {
    if (!is_small(*bodies_[first]) || !islands_.is_first_of_island(first)) continue;
    dBodyEnable(bodies_[first]->ode);
    const bool solved = solve_exactly(dt_s);
    for (Body* body : bodies_) {
      dBodyDisable(body->ode);
      if (!solved && is_small(*body) && islands_.same(first, body->number)) put_back(*body);
    }
    if (solved) continue;
    dBodyEnable(bodies_[first]->ode);
    solve_iteratively(std::max(spec_.iterations, kFallbackIterations), dt_s);
  }
}

void PhysicsEngine::put_back(const Body& body) {
  push(body);
  load(body);
  dBodyDisable(body.ode);
}

void PhysicsEngine::load_rotors(double dt_s) {
  for (const SpunCarrier& carrier : spun_carriers_) {
    Body& body = *carrier.body;
    body.rotor_momentum.setZero();
    Eigen::Vector3d reaction = Eigen::Vector3d::Zero();
    for (std::size_t i = carrier.first; i < carrier.last; ++i) {
      const Joint& joint = *spun_joints_[i];
      body.rotor_momentum += joint.axial_inertia * joint.spun_velocity * joint.axis_body;
      if (rotor_axes_lag_) reaction += rotor_axis_reaction(joint, spec_.erp, dt_s);
    }
    if (rotor_axes_lag_) body.torque += body.R_world_body * reaction;
  }
}

void PhysicsEngine::advance_rotors(double dt_s) {
  // Nothing turns a rotor about its axis within a step, so it keeps its rate in space and the
  // carrier's own turning shows in the joint rate; its motor sets the rate anew in the next step.
  for (const SpunCarrier& carrier : spun_carriers_) {
    const Body& body = *carrier.body;
    const Eigen::Vector3d w_body = body.R_world_body.transpose() * body.w_world;
    const Eigen::Vector3d dw_body = body.R_world_body.transpose() * (body.w_world - body.w_before);
    for (std::size_t i = carrier.first; i < carrier.last; ++i) {
      Joint& joint = *spun_joints_[i];
      joint.spun_position += dt_s * joint.spun_velocity;
      joint.spun_velocity -= joint.axis_body.dot(dw_body);
    }
    if (!rotor_axes_lag_) continue;
    advance_rotor_axes({&spun_joints_[carrier.first], carrier.last - carrier.first}, w_body,
                       spec_.erp, dt_s);
  }
}

}  // namespace trident
