// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "joint_anchor.h"

#include <cmath>

#include "trident_base/error.h"

namespace trident::sim {
namespace {

/// Cosine of the angle that the axes of a universal joint may miss a right angle by.
constexpr double kSquare = 1e-3;

/// Inverse mass: zero for what forces do not move, the world and kinematic bodies.
double mobility_of(const Body* body) {
  return body == nullptr || body->is_kinematic() ? 0.0 : 1.0 / body->mass();
}

/// One over the inertia of `body`, as spawned, about an axis through `anchor` [1/(kg m^2)].
double mobility_about(const Body* body, const Eigen::Vector3d& axis,
                      const Eigen::Vector3d& anchor) {
  if (body == nullptr || body->is_kinematic()) return 0.0;
  const SE3& T = engine_body(body)->T_world_body_initial;
  const Eigen::Vector3d axis_body = T.R.toRotationMatrix().transpose() * axis;
  const Eigen::Vector3d arm = axis.cross(T.p - anchor);
  return 1.0 /
         (axis_body.dot(body->inertia_tensor() * axis_body) + body->mass() * arm.squaredNorm());
}

SE3 spawned(const Body* body) {
  return body == nullptr ? SE3::identity() : engine_body(body)->T_world_body_initial;
}

/// A joint in the world, as spawned.
struct Placed {
  Eigen::Vector3d anchor, axis, axis2;
};

/// Fills what does not depend on the kind of joint. `of_to`: whether `to` carries the axis.
void lay_axis(JointAxis& axis, Body* from, Body* to, bool of_to, const Eigen::Vector3d& axis_world,
              const Eigen::Vector3d& anchor) {
  axis.from = from;
  axis.to = to;
  axis.carrier = of_to ? to : from;
  axis.axis_carrier = spawned(axis.carrier).R.conjugate() * axis_world;
  axis.p_from_anchor = spawned(from).inverse() * anchor;
  axis.p_to_anchor = spawned(to).inverse() * anchor;
  axis.R_from_to_zero = spawned(from).R.conjugate() * spawned(to).R;
  const double mobility = axis.linear ? mobility_of(from) + mobility_of(to)
                                      : mobility_about(from, axis_world, anchor) +
                                            mobility_about(to, axis_world, anchor);
  axis.inertia = mobility > 0.0 ? 1.0 / mobility : 0.0;
}

/// A gearbox' axes run from the reference body, those of all other joints from the parent.
void lay_axes(Joint& joint, const Placed& placed) {
  Body* child = joint.child->body;
  Body* parent = joint.parent == nullptr ? nullptr : joint.parent->body;
  JointAxis &first = joint.axes[0], &second = joint.axes[1];
  first.linear = joint.spec.type == JointType::kPrismatic;
  if (joint.spec.type == JointType::kUniversal) {
    lay_axis(first, parent, child, false, placed.axis, placed.anchor);
    lay_axis(second, parent, child, true, placed.axis2, placed.anchor);
  } else if (joint.spec.type == JointType::kGearbox) {
    lay_axis(first, joint.reference, parent, true, placed.axis, spawned(parent).p);
    lay_axis(second, joint.reference, child, true, placed.axis2, spawned(child).p);
  } else {
    lay_axis(first, parent, child, child != nullptr, placed.axis, placed.anchor);
  }
}

void anchor_universal(const Joint& joint, const Placed& placed, double sign) {
  if (std::abs(placed.axis.dot(placed.axis2)) > kSquare) {
    throw Error("joint '" + joint.spec.name + "': the axes of a universal joint are " +
                std::to_string(std::acos(placed.axis.dot(placed.axis2))) +
                " rad apart, must be pi/2");
  }
  // ODE's first axis is that of its first body.
  const Eigen::Vector3d one = sign * (sign > 0.0 ? placed.axis2 : placed.axis);
  const Eigen::Vector3d two = sign * (sign > 0.0 ? placed.axis : placed.axis2);
  dJointSetUniversalAnchor(joint.ode->id, placed.anchor.x(), placed.anchor.y(), placed.anchor.z());
  dJointSetUniversalAxis1(joint.ode->id, one.x(), one.y(), one.z());
  dJointSetUniversalAxis2(joint.ode->id, two.x(), two.y(), two.z());
}

}  // namespace

void place_as_spawned(const Model& model) {
  for (const auto& body : model.bodies) {
    const EngineBody& own = engine_body(*body);
    const SE3& T = own.T_world_body_initial;
    dBodySetPosition(own.ode, T.p.x(), T.p.y(), T.p.z());
    const dQuaternion q = {T.R.w(), T.R.x(), T.R.y(), T.R.z()};
    dBodySetQuaternion(own.ode, q);
  }
}

/// In the pose of the spawn: ODE takes the present place of both bodies for the joint's zero.
void anchor_joint(const Model& model, Joint& joint) {
  const Eigen::Quaterniond& R = model.T_world_model_initial.R;
  const Placed placed{model.T_world_model_initial * joint.spec.T_model_joint.p,
                      R * joint.spec.axis_model, R * joint.spec.axis2.axis_model};
  lay_axes(joint, placed);
  // ODE wants a body first. When that is the parent, its axis turned round keeps all signs.
  const double sign = joint.child->body != nullptr ? 1.0 : -1.0;
  const Eigen::Vector3d axis = sign * placed.axis;
  const Eigen::Vector3d& anchor = placed.anchor;
  switch (joint.spec.type) {
    case JointType::kRevolute:
      dJointSetHingeAnchor(joint.ode->id, anchor.x(), anchor.y(), anchor.z());
      dJointSetHingeAxis(joint.ode->id, axis.x(), axis.y(), axis.z());
      break;
    case JointType::kPrismatic:
      dJointSetSliderAxis(joint.ode->id, axis.x(), axis.y(), axis.z());
      break;
    case JointType::kScrew:
      dJointSetPistonAnchor(joint.ode->id, anchor.x(), anchor.y(), anchor.z());
      dJointSetPistonAxis(joint.ode->id, axis.x(), axis.y(), axis.z());
      break;
    case JointType::kBall:
      dJointSetBallAnchor(joint.ode->id, anchor.x(), anchor.y(), anchor.z());
      break;
    case JointType::kUniversal:
      anchor_universal(joint, placed, sign);
      break;
    case JointType::kGearbox:
    case JointType::kFixed:
      break;
  }
}

}  // namespace trident::sim
