// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "constraint_solver.h"

#include <algorithm>
#include <limits>

#include "core/physics/body_sync.h"
#include "core/physics/free_body.h"
#include "core/physics/ode_context.h"
#include "core/physics/ode_joint.h"

namespace trident::sim {
namespace {

constexpr int kRowsPerContact = 3, kRowsPerJoint = 6;

/// Of an island that the exact solver fails on; few enough rows for these to be quick.
constexpr int kFallbackIterations = 500;

/// What ODE takes by itself for every constraint. Without any the exact solver has no solution for
/// joints in a closed loop, and ODE ends the process.
constexpr double kMinJointCfm = 1e-10;

/// Accelerations that nothing survives [m/s^2], [rad/s^2]. ODE ends the program when a rotation
/// overflows; below these it does not, and the body is frozen after the step.
constexpr double kMaxAcceleration = 1e14;

bool is_constrained(const EngineBody& body) { return body.joint_count > 0 || body.in_contact; }

Eigen::Vector3d bounded(const Eigen::Vector3d& v, double limit) {
  if (!v.allFinite()) return Eigen::Vector3d::Constant(limit);
  return v.cwiseMax(-limit).cwiseMin(limit);
}

/// Hands the forces of this step to ODE.
void load(const EngineBody& body) {
  const double smallest_inertia = body.composite.inertia.diagonal().minCoeff();
  const Eigen::Vector3d force = bounded(body.force, kMaxAcceleration * body.composite.mass_kg);
  const Eigen::Vector3d torque =
      bounded(body.torque + gyroscopic_torque(body), kMaxAcceleration * smallest_inertia);
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

ConstraintSolver::ConstraintSolver(dWorldID world)
    : world_(world), stepper_(world), joints_(dJointGroupCreate(0)) {}

ConstraintSolver::~ConstraintSolver() { dJointGroupDestroy(joints_); }

void ConstraintSolver::configure(const PhysicsSpec& spec) {
  spec_ = spec;
  dWorldSetERP(world_, spec.erp);
  dWorldSetQuickStepW(world_, spec.sor);
  // Each contact is given its depth so that these two, which ODE has once for the world, do
  // nothing.
  dWorldSetContactSurfaceLayer(world_, 0.0);
  dWorldSetContactMaxCorrectingVel(world_, dInfinity);
}

void ConstraintSolver::begin_step(std::size_t bodies) {
  if (has_joints_) dJointGroupEmpty(joints_);
  has_joints_ = false;
  touches_.clear();
  next_in_memory_ = 0;
  islands_.reset(bodies);
}

void ConstraintSolver::add(const Touch& touch) {
  touches_.push_back(touch);
  touches_.back().mu = {touch.ode.surface.mu, touch.ode.surface.mu2};
  recall(touches_.back());
  islands_.add_rows(touch.a->number, kRowsPerContact);
  if (touch.b != nullptr) islands_.join(touch.a->number, touch.b->number);
}

void ConstraintSolver::solve(const std::vector<EngineBody*>& bodies,
                             const std::vector<Joint*>& joints, double dt_s) {
  gather(bodies, joints);
  if (held_.bodies.empty()) return forget();
  dWorldSetCFM(world_, joints.empty() ? spec_.cfm : std::max(spec_.cfm, kMinJointCfm));
  for (Joint* joint : joints) prepare_ode_joint(*joint, spec_.erp, dt_s);
  for (Joint* joint : joints) apply_efforts(*joint, dt_s);
  for (const EngineBody* body : held_.bodies) load(*body);
  active_.assign(bodies.size(), 1);
  is_solved_twice_.assign(bodies.size(), 0);
  friction_.resize(bodies.size());
  is_warm_.resize(bodies.size());
  solve_pass(Pass::kPose, dt_s);
  const bool any_bounded = choose_bounded();
  keep_normals(Pass::kPose);
  if (any_bounded) {
    held_.poses.resize(held_.bodies.size());
    for (std::size_t i = 0; i < held_.bodies.size(); ++i)
      held_.poses[i] = ode_pose(*held_.bodies[i]);
    put_back_active();
    solve_pass(Pass::kVelocity, dt_s);
    keep_normals(Pass::kVelocity);
  }
  finish(dt_s);
}

void ConstraintSolver::gather(const std::vector<EngineBody*>& bodies,
                              const std::vector<Joint*>& joints) {
  for (const Joint* joint : joints) {
    const std::size_t first = engine_body(joint->held.front())->number;
    islands_.add_rows(first, kRowsPerJoint);
    for (const Body* body : joint->held) islands_.join(first, engine_body(body)->number);
  }
  held_.bodies.clear();
  held_.islands.clear();
  for (EngineBody* body : bodies) {
    if (!is_constrained(*body)) continue;
    push(*body);  // joints are read where ODE has their bodies
    held_.bodies.push_back(body);
    held_.islands.push_back(islands_.first_of_island(body->number));
  }
}

/// Leaves those islands active in which a velocity is to be bounded; false without any.
bool ConstraintSolver::choose_bounded() {
  std::fill(active_.begin(), active_.end(), 0);
  bool any = false;
  for (const Touch& touch : touches_) {
    if (touch.depth_m[1] >= touch.depth_m[0]) continue;
    const std::size_t island = island_of(touch);
    active_[island] = is_solved_twice_[island] = 1;
    any = true;
  }
  return any;
}

bool ConstraintSolver::is_large(std::size_t island) {
  return spec_.solver == "quick" && islands_.rows_of_island(island) > spec_.exact_solver_rows;
}

void ConstraintSolver::solve_pass(Pass pass, double dt_s) {
  choose_warm(pass);
  make_joints(pass, false);
  solve_large(dt_s);
  solve_small(dt_s);
  refine_friction(pass, dt_s);
}

/// ODE goes through an island from its first enabled body on and wakes the others: enabling the one
/// of the first name makes the order of rows, hence rounding, independent of who came first.
void ConstraintSolver::enable_active() {
  for (std::size_t i = 0; i < held_.bodies.size(); ++i) {
    if (held_.bodies[i]->number == held_.islands[i] && active_[held_.islands[i]])
      dBodyEnable(held_.bodies[i]->ode);
  }
}

void ConstraintSolver::disable_all() const {
  for (const EngineBody* body : held_.bodies) dBodyDisable(body->ode);
}

void ConstraintSolver::put_back_active() {
  for (std::size_t i = 0; i < held_.bodies.size(); ++i) {
    if (!active_[held_.islands[i]]) continue;
    push(*held_.bodies[i]);
    load(*held_.bodies[i]);
    dBodyDisable(held_.bodies[i]->ode);
  }
}

void ConstraintSolver::solve_large(double dt_s) {
  for (std::size_t i = 0; i < held_.bodies.size(); ++i) {
    const std::size_t island = held_.islands[i];
    if (held_.bodies[i]->number != island || !active_[island] || !is_large(island)) continue;
    dBodyEnable(held_.bodies[i]->ode);
    if (!solve_iteratively(spec_.iterations, dt_s)) give_up(island);
    active_[island] = 0;
  }
}

void ConstraintSolver::solve_small(double dt_s) {
  enable_active();
  const bool solved = solve_exactly(dt_s);
  disable_all();
  if (!solved) solve_one_by_one(dt_s);
}

bool ConstraintSolver::solve_iteratively(int iterations, double dt_s) {
  dWorldSetQuickStepNumIterations(world_, iterations);
  dRandSetSeed(0);  // the iterative solver shuffles its rows: in the same order in every step
  const bool solved = stepper_.run(dWorldQuickStep, dt_s);
  disable_all();  // the next island is solved alone
  return solved;
}

bool ConstraintSolver::solve_exactly(double dt_s) {
  const std::uint64_t messages = ode_message_count();
  return stepper_.run(dWorldStep, dt_s) && ode_message_count() == messages;
}

void ConstraintSolver::put_back(std::size_t island) {
  for (std::size_t i = 0; i < held_.bodies.size(); ++i) {
    if (held_.islands[i] != island) continue;
    push(*held_.bodies[i]);
    load(*held_.bodies[i]);
    dBodyDisable(held_.bodies[i]->ode);
  }
}

/// Bodies that neither solver finds a velocity for get none: they are frozen after the step.
void ConstraintSolver::give_up(std::size_t island) {
  put_back(island);
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < held_.bodies.size(); ++i) {
    if (held_.islands[i] == island) dBodySetLinearVel(held_.bodies[i]->ode, none, none, none);
  }
}

/// The exact solver may fail on a pile in the moment in which a contact opens, and then leaves out
/// rows: a body falls freely for a step. The step is done again, the islands that fail with the
/// other solver, the others to the same result.
void ConstraintSolver::solve_one_by_one(double dt_s) {
  put_back_active();
  for (std::size_t i = 0; i < held_.bodies.size(); ++i) {
    const std::size_t island = held_.islands[i];
    if (held_.bodies[i]->number != island || !active_[island]) continue;
    dBodyEnable(held_.bodies[i]->ode);
    const bool solved = solve_exactly(dt_s);
    disable_all();
    if (solved) continue;
    put_back(island);
    dBodyEnable(held_.bodies[i]->ode);
    if (!solve_iteratively(std::max(spec_.iterations, kFallbackIterations), dt_s)) give_up(island);
    active_[island] = 0;
  }
}

namespace {

/// `is_limit_known`: friction is limited by `limiting_normal_n`, else by the normal force that the
/// solver makes out.
void set_friction(Touch& touch, bool is_limit_known) {
  dSurfaceParameters& surface = touch.ode.surface;
  surface.mode |= dContactApprox1;
  surface.mu = touch.mu[0];
  surface.mu2 = touch.mu[1];
  if (!is_limit_known) return;
  const double normal = touch.limiting_normal_n;
  surface.mode &= ~dContactApprox1;
  surface.mu = normal > 0.0 ? touch.mu[0] * normal : 0.0;
  surface.mu2 = normal > 0.0 ? touch.mu[1] * normal : 0.0;
}

}  // namespace

/// `limits_known`: friction is limited by the normal forces of the last round, else by those of the
/// last step where they are known, else by those that the solver makes out.
void ConstraintSolver::make_joints(Pass pass, bool limits_known) {
  if (has_joints_) dJointGroupEmpty(joints_);
  has_joints_ = false;
  for (Touch& touch : touches_) {
    const std::size_t island = island_of(touch);
    if (!active_[island]) continue;
    touch.ode.geom.depth = touch.depth_m[static_cast<std::size_t>(pass)];
    set_friction(touch, limits_known || is_warm_[island]);
    const dJointID joint = dJointCreateContact(world_, joints_, &touch.ode);
    dJointAttach(joint, touch.a->ode, touch.b != nullptr ? touch.b->ode : nullptr);
    dJointSetFeedback(joint, &touch.feedback);
    has_joints_ = true;
  }
}

void ConstraintSolver::finish(double dt_s) {
  for (std::size_t i = 0; i < held_.bodies.size(); ++i) {
    EngineBody& body = *held_.bodies[i];
    pull(body);
    if (is_solved_twice_[held_.islands[i]]) {
      body.T_world_body.p = held_.poses[i].p;
      body.set_orientation(held_.poses[i].R);
    }
    apply_velocity_decay(body, dt_s);
  }
  remember();
}

}  // namespace trident::sim
