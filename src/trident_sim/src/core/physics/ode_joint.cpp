// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "ode_joint.h"

#include <algorithm>
#include <cmath>

#include "joint_anchor.h"
#include "trident_base/angle.h"
#include "trident_base/error.h"

namespace trident::sim {
namespace {

using SetParam = void (*)(dJointID, int, dReal);

dBodyID ode_of(const Body* body) { return body == nullptr ? nullptr : engine_body(body)->ode; }
Body* body_of(const Link* link) { return link == nullptr ? nullptr : link->body; }

std::shared_ptr<OdeJoint> own(dJointID id) {
  auto joint = std::make_shared<OdeJoint>();
  joint->id = id;
  return joint;
}

/// ODE numbers the parameters of second and third axes in groups of 0x100.
constexpr int kSecondGroup = 0x100;

void set_limits(dJointID joint, SetParam set, int group, const AxisSpec& spec, double scale = 1.0) {
  // A left-handed thread has a negative scale, which exchanges the limits.
  const double lo = scale * (scale > 0.0 ? spec.lower : spec.upper);
  const double hi = scale * (scale > 0.0 ? spec.upper : spec.lower);
  if (std::isfinite(lo)) set(joint, dParamLoStop + group, lo);
  if (std::isfinite(hi)) set(joint, dParamHiStop + group, hi);
  if (spec.stop_erp) set(joint, dParamStopERP + group, *spec.stop_erp);
  if (spec.stop_cfm) set(joint, dParamStopCFM + group, *spec.stop_cfm);
}

/// Dry friction: a motor that wants to stand still.
void set_friction(dJointID joint, SetParam set, int group, const AxisSpec& spec) {
  if (!(spec.friction > 0.0)) return;
  set(joint, dParamVel + group, 0.0);
  set(joint, dParamFMax + group, spec.friction);
}

/// Attaches to child and parent, a body first.
void attach(dJointID joint, const Body* child, const Body* parent) {
  if (child != nullptr) {
    dJointAttach(joint, ode_of(child), ode_of(parent));
  } else {
    dJointAttach(joint, ode_of(parent), nullptr);
  }
}

dJointID make_motor(dWorldID world, const Body& shaft, const Body* other, int axes) {
  const dJointID motor = dJointCreateAMotor(world, nullptr);
  dJointAttach(motor, ode_of(&shaft), ode_of(other));
  // Axes are set by this file in each step, in world coordinates; a motor without limit on its
  // torque that is to stand still is a constraint.
  dJointSetAMotorMode(motor, dAMotorUser);
  dJointSetAMotorNumAxes(motor, axes);
  for (int i = 0; i < axes; ++i) {
    dJointSetAMotorParam(motor, dParamVel + kSecondGroup * i, 0.0);
    dJointSetAMotorParam(motor, dParamFMax + kSecondGroup * i, dInfinity);
  }
  return motor;
}

void make_gearbox(Joint& joint, dWorldID world) {
  joint.ode = own(make_motor(world, *joint.shaft, joint.reference, 2));
  // The last holds nothing; it only says that the two are joined and do not collide.
  joint.ode->more = {make_motor(world, *joint.shaft, body_of(joint.parent), 1),
                     make_motor(world, *joint.shaft, joint.child->body, 1),
                     make_motor(world, *joint.child->body, body_of(joint.parent), 0)};
}

void make_one_axis(Joint& joint, dWorldID world, dJointID (*create)(dWorldID, dJointGroupID),
                   SetParam set) {
  joint.ode = own(create(world, nullptr));
  attach(joint.ode->id, joint.child->body, body_of(joint.parent));
  set_limits(joint.ode->id, set, 0, joint.spec);
  set_friction(joint.ode->id, set, 0, joint.spec);
}

void make_universal(Joint& joint, dWorldID world) {
  joint.ode = own(dJointCreateUniversal(world, nullptr));
  attach(joint.ode->id, joint.child->body, body_of(joint.parent));
  // ODE's first axis is that of its first body, ours that of the parent.
  const bool is_child_first = joint.child->body != nullptr;
  const AxisSpec* specs[] = {&joint.spec, &joint.spec.axis2};
  for (int i = 0; i < 2; ++i) {
    const AxisSpec& spec = *specs[is_child_first ? 1 - i : i];
    set_limits(joint.ode->id, dJointSetUniversalParam, kSecondGroup * i, spec);
    set_friction(joint.ode->id, dJointSetUniversalParam, kSecondGroup * i, spec);
  }
}

/// Travel per radian [m/rad].
double lead(const Joint& joint) { return joint.spec.screw_pitch_m / (2.0 * kPi); }

/// A piston, which may turn and travel, and a rod between a point of each body that lies across
/// the thread: it can keep its length only while the two go together.
void make_screw(Joint& joint, dWorldID world) {
  const Body* child = joint.child->body;
  const Body* parent = body_of(joint.parent);
  joint.ode = own(dJointCreatePiston(world, nullptr));
  attach(joint.ode->id, child, parent);
  set_limits(joint.ode->id, dJointSetPistonParam, 0, joint.spec, lead(joint));
  set_friction(joint.ode->id, dJointSetPistonParam, kSecondGroup, joint.spec);
  joint.ode->more = {dJointCreateDBall(world, nullptr)};
  attach(joint.ode->more[0], child, parent);
}

void update_screw(const Joint& joint, double erp) {
  const JointAxis& axis = joint.axes[0];
  const Eigen::Vector3d along = axis.axis_world();
  const Eigen::Vector3d out = along.unitOrthogonal();
  const double k = lead(joint), radius = std::abs(k);
  // The rod's direction: of a helix with this lead, the normal at `radius`.
  const Eigen::Vector3d rod = std::sqrt(0.5) * (along - (k > 0.0 ? 1.0 : -1.0) * along.cross(out));
  const SE3 T_to = axis.to != nullptr ? axis.to->pose() : SE3::identity();
  const Eigen::Vector3d p = T_to * axis.p_to_anchor + radius * out, q = p - rod;
  const bool is_to_first = axis.to != nullptr;
  const Eigen::Vector3d one = is_to_first ? p : q, two = is_to_first ? q : p;
  // Travel that the angle does not account for is drift, which the rod's length takes back.
  const double error = axis.length() - k * joint.position();
  const dJointID ball = joint.ode->more[0];
  dJointSetDBallAnchor1(ball, one.x(), one.y(), one.z());
  dJointSetDBallAnchor2(ball, two.x(), two.y(), two.z());
  dJointSetDBallParam(ball, dParamERP, erp);
  // A screw that was torn apart comes back no faster than the rod is long.
  dJointSetDBallDistance(ball, 1.0 - std::clamp(std::sqrt(0.5) * error, -1.0, 1.0));
}

/// ODE sees angles in (-pi, pi] only. Limits beyond are moved by the turns that have been counted,
/// and hold in the turn that they are in.
void update_stops(const Joint& joint) {
  const AxisSpec& spec = joint.axes[0].spec;
  const bool is_above = std::isfinite(spec.upper) && spec.upper > kPi;
  const bool is_below = std::isfinite(spec.lower) && spec.lower < -kPi;
  if (!is_above && !is_below) return;
  const double turns = joint.position() - joint.axes[0].angle();
  const double lo = spec.lower - turns, hi = spec.upper - turns;
  dJointSetHingeParam(joint.ode->id, dParamLoStop, lo > -kPi ? lo : -dInfinity);
  dJointSetHingeParam(joint.ode->id, dParamHiStop, hi < kPi ? hi : dInfinity);
}

void update_motor(const Joint& joint) {
  const auto set =
      joint.spec.type == JointType::kPrismatic ? dJointSetSliderParam : dJointSetHingeParam;
  set(joint.ode->id, dParamVel, joint.motor->rate);
  set(joint.ode->id, dParamFMax, joint.motor->effort_limit);
}

void set_axis(dJointID motor, int number, const Eigen::Vector3d& axis_world) {
  dJointSetAMotorAxis(motor, number, 0, axis_world.x(), axis_world.y(), axis_world.z());
}

/// With the reference at rest, the parent turning at w about a, the child at u about b and the
/// shaft at s about f: the rows hold w = (f.a) s and (c.b) u = (c.f) s. f is 45 degrees from a, and
/// c lies between b and f such that u = -ratio w.
void update_gearbox(const Joint& joint, double erp, double dt_s) {
  const Eigen::Vector3d a = joint.axes[0].axis_world(), b = joint.axes[1].axis_world();
  const Eigen::Vector3d normal = a.cross(b);
  const Eigen::Vector3d across =
      normal.norm() > 1e-3 ? Eigen::Vector3d(normal.normalized()) : a.unitOrthogonal();
  const Eigen::Vector3d f = std::sqrt(0.5) * (a + across);
  const Eigen::Vector3d e = (f - b.dot(f) * b).normalized();
  const double ratio = joint.spec.gearbox_ratio;
  const double slope = (-ratio * f.dot(a) - f.dot(b)) / f.dot(e);
  const Eigen::Vector3d c = (b + slope * e).normalized();
  const Eigen::Vector3d side = f.unitOrthogonal();
  set_axis(joint.ode->id, 0, side);
  set_axis(joint.ode->id, 1, f.cross(side));
  set_axis(joint.ode->more[0], 0, a);
  set_axis(joint.ode->more[1], 0, c);
  const double error = joint.position(1) + ratio * joint.position(0);
  dJointSetAMotorParam(joint.ode->more[1], dParamVel, c.dot(b) * erp / dt_s * error);
}

void hold(Joint& joint, Body* body) {
  if (body == nullptr) return;
  joint.held.push_back(body);
  ++engine_body(body)->joint_count;
}

void make_kind(Joint& joint, dWorldID world) {
  switch (joint.spec.type) {
    case JointType::kRevolute:
      return make_one_axis(joint, world, dJointCreateHinge, dJointSetHingeParam);
    case JointType::kPrismatic:
      return make_one_axis(joint, world, dJointCreateSlider, dJointSetSliderParam);
    case JointType::kBall:
      joint.ode = own(dJointCreateBall(world, nullptr));
      return attach(joint.ode->id, joint.child->body, body_of(joint.parent));
    case JointType::kUniversal:
      return make_universal(joint, world);
    case JointType::kScrew:
      return make_screw(joint, world);
    case JointType::kGearbox:
      return make_gearbox(joint, world);
    case JointType::kFixed:
      break;
  }
}

}  // namespace

void make_ode_joint(const Model& model, Joint& joint, dWorldID world) {
  make_kind(joint, world);
  const AxisSpec* specs[] = {&joint.spec, &joint.spec.axis2};
  for (std::size_t i = 0; i < joint.axes.size(); ++i) {
    joint.axes[i].spec = *specs[i];
    joint.axes[i].damping = specs[i]->damping;
  }
  anchor_joint(model, joint);
  hold(joint, joint.child->body);
  hold(joint, body_of(joint.parent));
  hold(joint, joint.reference);
  hold(joint, joint.shaft);
}

void destroy_ode_joint(Joint& joint) {
  if (joint.ode == nullptr) return;
  dJointDestroy(joint.ode->id);
  for (const dJointID more : joint.ode->more) dJointDestroy(more);
  joint.ode.reset();
}

std::unique_ptr<Body> make_shaft(const Model& model, const Joint& joint, dWorldID world) {
  // The shaft is no part of the model and must not slow
  // it; lighter ones worsen the solver's condition.
  constexpr double kLight = 1e-4;
  auto shaft = std::make_unique<EngineBody>();
  shaft->name = model.name + "::" + joint.spec.name + "::shaft";
  double inertia = joint.child->body->inertia_tensor().trace();
  if (body_of(joint.parent) != nullptr) {
    inertia = std::min(inertia, joint.parent->body->inertia_tensor().trace());
  }
  shaft->composite.mass_kg = 1.0;
  shaft->composite.inertia = kLight * inertia * Eigen::Matrix3d::Identity();
  shaft->composite.inertia_inverse = shaft->composite.inertia.inverse();
  shaft->T_world_body = shaft->T_world_body_initial = joint.child->body->pose();
  shaft->set_orientation(shaft->T_world_body.R);
  shaft->owner = &model;
  shaft->ode = dBodyCreate(world);
  dMass mass;
  dMassSetParameters(&mass, 1.0, 0, 0, 0, kLight * inertia, kLight * inertia, kLight * inertia, 0,
                     0, 0);
  dBodySetMass(shaft->ode, &mass);
  dBodySetGyroscopicMode(shaft->ode, 0);
  dBodySetGravityMode(shaft->ode, 0);
  dBodySetAutoDisableFlag(shaft->ode, 0);
  dBodySetData(shaft->ode, shaft.get());
  dBodyDisable(shaft->ode);
  return shaft;
}

void prepare_ode_joint(Joint& joint, double erp, double dt_s) {
  if (joint.spec.type == JointType::kRevolute) update_stops(joint);
  if (joint.motor) update_motor(joint);
  if (joint.spec.type == JointType::kScrew) update_screw(joint, erp);
  if (joint.spec.type == JointType::kGearbox) update_gearbox(joint, erp, dt_s);
}

}  // namespace trident::sim
