// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "physics_engine.h"

#include <algorithm>
#include <numeric>

#include "free_body.h"
#include "ode_context.h"
#include "rotor_axis.h"

namespace trident {
namespace {

/// Up to this many constraint rows ODE's exact (Dantzig) solver is used whatever the world asks
/// for: it is then both faster and better than the iterative one.
constexpr int kExactSolverRows = 150;

void push(const Body& body) {
  const SE3& T = body.T_world_body;
  dBodySetPosition(body.ode, T.p.x(), T.p.y(), T.p.z());
  const dQuaternion q = {T.R.w(), T.R.x(), T.R.y(), T.R.z()};
  dBodySetQuaternion(body.ode, q);
  dBodySetLinearVel(body.ode, body.v_world.x(), body.v_world.y(), body.v_world.z());
  dBodySetAngularVel(body.ode, body.w_world.x(), body.w_world.y(), body.w_world.z());
}

void pull(Body& body) {
  const dReal* p = dBodyGetPosition(body.ode);
  const dReal* q = dBodyGetQuaternion(body.ode);
  const dReal* v = dBodyGetLinearVel(body.ode);
  const dReal* w = dBodyGetAngularVel(body.ode);
  body.T_world_body.p = {p[0], p[1], p[2]};
  body.set_orientation(Eigen::Quaterniond(q[0], q[1], q[2], q[3]));
  body.v_world = {v[0], v[1], v[2]};
  body.w_world = {w[0], w[1], w[2]};
}

/// Several contacts under one body hold it more often than it can move, which the exact solver
/// needs a little softness to tell apart: 1e8 N/m at a step of 10 ms, and 1e-8 m/s of creep per
/// newton.
constexpr double kLeastNormalCfm = 1e-6;
constexpr double kLeastSlip = 1e-8;

/// Contact parameters of a pair, combined as Gazebo combines them: springs in series, dampers in
/// parallel, the smaller friction and restitution.
dSurfaceParameters combine(const Surface& a, const Surface& b, double dt_s) {
  dSurfaceParameters surface{};
  const double kp = 1.0 / (1.0 / a.kp_n_m + 1.0 / b.kp_n_m);
  const double kd = a.kd_ns_m + b.kd_ns_m;
  surface.mode = dContactBounce | dContactMu2 | dContactSoftERP | dContactSoftCFM |
                 dContactApprox1 | dContactSlip1 | dContactSlip2;
  surface.mu = std::min(a.mu, b.mu);
  surface.mu2 = std::min(a.mu2, b.mu2);
  surface.slip1 = std::max(kLeastSlip, std::min(a.slip1, b.slip1));
  surface.slip2 = std::max(kLeastSlip, std::min(a.slip2, b.slip2));
  surface.bounce = std::min(a.restitution, b.restitution);
  surface.bounce_vel = std::min(a.bounce_threshold_m_s, b.bounce_threshold_m_s);
  surface.soft_erp = dt_s * kp / (dt_s * kp + kd);
  surface.soft_cfm = std::max(kLeastNormalCfm, 1.0 / (dt_s * kp + kd));
  return surface;
}

bool boxes_overlap(const dReal* a, const dReal* b) {
  return a[0] <= b[1] && b[0] <= a[1] && a[2] <= b[3] && b[2] <= a[3] && a[4] <= b[5] &&
         b[4] <= a[5];
}

}  // namespace

PhysicsEngine::PhysicsEngine(const PhysicsSpec& spec, bool rotor_axes_lag, Report report)
    : report_(std::move(report)), rotor_axes_lag_(rotor_axes_lag), contact_buffer_(64) {
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
  dWorldSetCFM(world_, spec.cfm);
  dWorldSetContactSurfaceLayer(world_, spec.contact_surface_layer);
  dWorldSetContactMaxCorrectingVel(world_, spec.contact_max_correcting_vel);
  dWorldSetQuickStepNumIterations(world_, spec.iterations);
  dWorldSetQuickStepW(world_, spec.sor);
  dWorldSetAutoDisableFlag(world_, 0);
  contact_buffer_.resize(static_cast<std::size_t>(std::clamp(spec.max_contacts, 1, 64)));
}

void PhysicsEngine::set_models(const std::vector<Model*>& models) {
  bodies_.clear();
  ode_joints_.clear();
  spun_joints_.clear();
  spun_carriers_.clear();
  statics_.clear();
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
  for (Joint* joint : spun_joints_) {
    Body* body = joint->child->body;
    if (spun_carriers_.empty() || spun_carriers_.back() != body) spun_carriers_.push_back(body);
  }
  centres_.resize(bodies_.size());
  order_.resize(bodies_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
}

void PhysicsEngine::push_state(Model& model) {
  for (const auto& body : model.bodies) push(*body);
}

void PhysicsEngine::step(double dt_s) {
  for (Body* body : spun_carriers_) body->rotor_momentum.setZero();
  for (const Joint* joint : spun_joints_) {
    joint->child->body->rotor_momentum +=
        joint->axial_inertia * joint->spun_velocity * joint->axis_body;
    if (!rotor_axes_lag_) continue;
    Body& body = *joint->child->body;
    body.torque += body.R_world_body * rotor_axis_reaction(*joint, spec_.erp, dt_s);
  }
  for (Body* body : bodies_) {
    body->in_contact = false;
    body->T_before = body->T_world_body;
    body->v_before = body->v_world;
    body->w_before = body->w_world;
    if (body->gravity) body->force += body->mass_kg * gravity_;
  }
  find_contacts(dt_s);
  bool constrained = false;
  for (Body* body : bodies_) {
    if (body->joint_count > 0 || body->in_contact) {
      constrained = true;
    } else if (!body->frozen) {
      integrate_free_body(*body, dt_s);
    }
  }
  if (constrained) solve_constrained(dt_s);
  advance_rotors(dt_s);
  for (Body* body : bodies_) {
    body->force.setZero();
    body->torque.setZero();
    if (is_diverged(*body)) freeze(*body);
  }
}

void PhysicsEngine::freeze(Body& body) {
  report_(
      "body '" + body.name +
      "': its state grows without bound (over 1e5 m/s, 1e4 rad/s or 1e7 m, or not a number); it "
      "stands still from here until a reset");
  body.T_world_body.p = body.T_before.p;
  body.set_orientation(body.T_before.R);
  body.v_world.setZero();
  body.w_world.setZero();
  body.frozen = true;
}

void PhysicsEngine::find_contacts(double dt_s) {
  if (contact_count_ > 0) dJointGroupEmpty(contacts_);
  contact_count_ = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = *bodies_[i];
    centres_[i] = body.T_world_body.p + body.R_world_body * body.bound_centre;
    if (body.bound_radius_m > 0.0 && !body.frozen) collide_with_static(body, centres_[i], dt_s);
  }
  sweep_bodies(dt_s);
}

void PhysicsEngine::sweep_bodies(double dt_s) {
  const auto low = [this](std::size_t i) { return centres_[i].x() - bodies_[i]->bound_radius_m; };
  // Insertion sort: the order hardly changes from step to step.
  for (std::size_t k = 1; k < order_.size(); ++k) {
    const std::size_t moved = order_[k];
    std::size_t at = k;
    for (; at > 0 && low(order_[at - 1]) > low(moved); --at) order_[at] = order_[at - 1];
    order_[at] = moved;
  }
  for (std::size_t k = 0; k < order_.size(); ++k) {
    const std::size_t i = order_[k];
    const double high = centres_[i].x() + bodies_[i]->bound_radius_m;
    for (std::size_t m = k + 1; m < order_.size() && low(order_[m]) <= high; ++m) {
      const std::size_t j = order_[m];
      const double reach = bodies_[i]->bound_radius_m + bodies_[j]->bound_radius_m;
      if ((centres_[i] - centres_[j]).squaredNorm() > reach * reach) continue;
      collide_bodies(*bodies_[std::min(i, j)], *bodies_[std::max(i, j)], dt_s);
    }
  }
}

void PhysicsEngine::collide_with_static(Body& body, const Eigen::Vector3d& centre, double dt_s) {
  bool pushed = false;
  for (const StaticGeom& other : statics_) {
    if (other.is_plane) {
      if (other.normal.dot(centre) - other.offset > body.bound_radius_m) continue;
    } else {
      const Eigen::Vector3d nearest = centre.cwiseMax(other.lo).cwiseMin(other.hi);
      if ((nearest - centre).squaredNorm() > body.bound_radius_m * body.bound_radius_m) continue;
    }
    if (!pushed) push(body);
    pushed = true;
    for (Geom& geom : body.geoms) collide_geoms(geom, &body, *other.geom, nullptr, dt_s);
  }
}

void PhysicsEngine::collide_bodies(Body& a, Body& b, double dt_s) {
  if (a.owner == b.owner && !a.self_collide) return;
  if (a.frozen || b.frozen) return;
  if (dAreConnectedExcluding(a.ode, b.ode, dJointTypeContact)) return;
  push(a);
  push(b);
  for (Geom& geom_a : a.geoms) {
    for (Geom& geom_b : b.geoms) collide_geoms(geom_a, &a, geom_b, &b, dt_s);
  }
}

void PhysicsEngine::collide_geoms(Geom& a, Body* body_a, Geom& b, Body* body_b, double dt_s) {
  if ((a.surface.collide_bitmask & b.surface.collide_bitmask) == 0) return;
  dReal box_a[6], box_b[6];
  dGeomGetAABB(a.id, box_a);
  dGeomGetAABB(b.id, box_b);
  if (!boxes_overlap(box_a, box_b)) return;
  const int found = dCollide(a.id, b.id, static_cast<int>(contact_buffer_.size()),
                             &contact_buffer_[0].geom, sizeof(dContact));
  for (int i = 0; i < found; ++i) {
    dContact& contact = contact_buffer_[static_cast<std::size_t>(i)];
    contact.surface = combine(a.surface, b.surface, dt_s);
    if (!a.surface.fdir1.isZero() && body_a != nullptr) {
      const Eigen::Vector3d direction = body_a->R_world_body * a.surface.fdir1;
      const Eigen::Vector3d normal(contact.geom.normal[0], contact.geom.normal[1],
                                   contact.geom.normal[2]);
      const Eigen::Vector3d tangent = direction - normal * normal.dot(direction);
      if (tangent.norm() > 1e-9) {
        contact.surface.mode |= dContactFDir1;
        for (int k = 0; k < 3; ++k) contact.fdir1[k] = tangent.normalized()[k];
      }
    }
    const dJointID joint = dJointCreateContact(world_, contacts_, &contact);
    dJointAttach(joint, body_a ? body_a->ode : nullptr, body_b ? body_b->ode : nullptr);
    ++contact_count_;
  }
  if (found > 0) {
    body_a->in_contact = true;
    if (body_b != nullptr) body_b->in_contact = true;
  }
}

void PhysicsEngine::solve_constrained(double dt_s) {
  for (Body* body : bodies_) {
    if (body->joint_count == 0 && !body->in_contact) continue;
    push(*body);
    const Eigen::Vector3d torque = body->torque + gyroscopic_torque(*body);
    dBodySetForce(body->ode, body->force.x(), body->force.y(), body->force.z());
    dBodySetTorque(body->ode, torque.x(), torque.y(), torque.z());
    dBodyEnable(body->ode);
  }
  for (Joint* joint : ode_joints_) {
    const double effort = joint->force - joint->damping * joint->velocity();
    joint->force = 0.0;
    if (effort == 0.0) continue;
    const double limited = std::clamp(effort, -joint->spec.effort, joint->spec.effort);
    if (joint->spec.type == JointType::kRevolute) {
      dJointAddHingeTorque(joint->ode, limited);
    } else {
      dJointAddSliderForce(joint->ode, limited);
    }
  }
  const std::uint64_t messages = ode_message_count();
  const int rows = 3 * contact_count_ + 6 * static_cast<int>(ode_joints_.size());
  if (spec_.solver == "quick" && rows > kExactSolverRows) {
    dWorldQuickStep(world_, dt_s);
  } else {
    dWorldStep(world_, dt_s);
  }
  if (ode_message_count() != messages && !solver_told_) {
    solver_told_ = true;
    report_("physics: the solver reports '" + last_ode_message() +
            "'; contacts may be inaccurate (said once)");
  }
  for (Body* body : bodies_) {
    if (body->joint_count == 0 && !body->in_contact) continue;
    pull(*body);
    apply_velocity_decay(*body, dt_s);
    dBodyDisable(body->ode);
  }
}

void PhysicsEngine::advance_rotors(double dt_s) {
  // Nothing turns a rotor about its axis within a step, so it keeps its rate in space and the
  // carrier's own turning shows in the joint rate; its motor sets the rate anew in the next step.
  for (Joint* joint : spun_joints_) {
    const Body& body = *joint->child->body;
    joint->spun_position += dt_s * joint->spun_velocity;
    const Eigen::Vector3d dw_world = body.w_world - body.w_before;
    joint->spun_velocity -= joint->axis_body.dot(body.R_world_body.transpose() * dw_world);
    if (rotor_axes_lag_) advance_rotor_axis(*joint, spec_.erp, dt_s);
  }
}

}  // namespace trident
