// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "core/physics/engine_body.h"
#include "trident_sim/model.h"

namespace trident::sim {
namespace {

constexpr double kTurn = 6.283185307179586;

SE3 pose_of(const Body* body) { return body == nullptr ? SE3::identity() : body->pose(); }

Eigen::Vector3d turned_by(const Body* body, const Eigen::Vector3d& v) {
  return body == nullptr ? v : Eigen::Vector3d(body->rotation() * v);
}

Eigen::Vector3d w_of(const Body* body) {
  return body == nullptr ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : body->angular_velocity();
}

Eigen::Vector3d v_of(const Body* body, const Eigen::Vector3d& p_world) {
  return body == nullptr ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : body->velocity_at(p_world);
}

/// The part of a rotation about an axis (swing-twist decomposition), in (-pi, pi].
double angle_about(const Eigen::Quaterniond& turn, const Eigen::Vector3d& axis) {
  const double angle = 2.0 * std::atan2(turn.vec().dot(axis), turn.w());
  return angle - kTurn * std::round(angle / kTurn);
}

/// Angles of a universal joint: its turn is one about the first axis, which `from` carries, after
/// one about the second, which `to` carries.
double universal_angle(const Joint& joint, std::size_t axis) {
  const Eigen::Quaterniond turn = joint.axes[0].turn();
  const Eigen::Vector3d& first = joint.axes[0].axis_carrier;
  const Eigen::Vector3d second = joint.axes[0].R_from_to_zero * joint.axes[1].axis_carrier;
  if (axis == 0) {
    const Eigen::Vector3d moved = turn * second;
    return std::atan2(first.dot(second.cross(moved)), second.dot(moved));
  }
  const Eigen::Vector3d moved = turn.conjugate() * first;
  return -std::atan2(second.dot(first.cross(moved)), first.dot(moved));
}

/// Of an angle the turn nearest to the last one: exact as long as a step turns less than half a
/// revolution.
double measure(const Joint& joint, std::size_t axis) {
  const JointAxis& of = joint.axes[axis];
  if (of.linear) return of.length();
  const double angle =
      joint.spec.type == JointType::kUniversal ? universal_angle(joint, axis) : of.angle();
  return angle + kTurn * std::round((of.turned - angle) / kTurn);
}

}  // namespace

Eigen::Vector3d JointAxis::axis_world() const { return turned_by(carrier, axis_carrier); }

Eigen::Quaterniond JointAxis::turn() const {
  return pose_of(from).R.conjugate() * pose_of(to).R * R_from_to_zero.conjugate();
}

double JointAxis::angle() const {
  // An axis that turns with `to` is the same in `from` as long as it is the one that is turned
  // about.
  const Eigen::Vector3d axis_from =
      carrier == from ? axis_carrier : Eigen::Vector3d(R_from_to_zero * axis_carrier);
  return angle_about(turn(), axis_from);
}

double JointAxis::angle_rate() const { return (w_of(to) - w_of(from)).dot(axis_world()); }

double JointAxis::length() const {
  return (pose_of(to) * p_to_anchor - pose_of(from) * p_from_anchor).dot(axis_world());
}

double JointAxis::length_rate() const {
  const Eigen::Vector3d p_world = pose_of(to) * p_to_anchor;
  return (v_of(to, p_world) - v_of(from, p_world)).dot(axis_world());
}

/// Equal and opposite, so that a drive adds no momentum to the pair. A force acts at the child's
/// anchor on both bodies.
void JointAxis::push(double effort) const {
  const Eigen::Vector3d along = effort * axis_world();
  const Eigen::Vector3d p_world = pose_of(to) * p_to_anchor;
  for (Body* body : {to, from}) {
    if (body == nullptr) continue;
    const Eigen::Vector3d part = body == to ? along : Eigen::Vector3d(-along);
    if (linear) {
      body->add_force_at(part, p_world);
    } else {
      body->apply_torque(part);
    }
  }
}

std::size_t Joint::axis_count() const {
  if (is_rotor) return 1;
  if (ode == nullptr || spec.type == JointType::kBall) return 0;
  return spec.type == JointType::kUniversal || spec.type == JointType::kGearbox ? 2 : 1;
}

double Joint::position(std::size_t axis) const {
  if (is_rotor) return rotor_position;
  return axis < axis_count() ? measure(*this, axis) : 0.0;
}

double Joint::velocity(std::size_t axis) const {
  if (is_rotor) return rotor_velocity;
  if (axis >= axis_count()) return 0.0;
  return axes[axis].linear ? axes[axis].length_rate() : axes[axis].angle_rate();
}

/// Changes the child alone. An angular rate turns it about the anchor, which keeps its velocity.
void Joint::set_velocity(double rate) {
  if (is_rotor) {
    rotor_velocity = rate;
    return;
  }
  if (axis_count() != 1 || axes[0].to == nullptr) return;
  const JointAxis& axis = axes[0];
  const Eigen::Vector3d change = (rate - velocity()) * axis.axis_world();
  EngineBody& body = engine_body(*axis.to);
  if (axis.linear) {
    body.v_world += change;
    return;
  }
  body.w_world += change;
  body.v_world += change.cross(body.T_world_body.p - body.T_world_body * axis.p_to_anchor);
  if (spec.type == JointType::kScrew) body.v_world += spec.screw_pitch_m / kTurn * change;
}

/// After each step and not when asked for: a joint that nobody reads counts its turns, too.
void Joint::count_turns() {
  for (std::size_t i = 0; i < axis_count(); ++i) axes[i].turned = measure(*this, i);
}

void Joint::reset() {
  rotor_position = 0.0;
  rotor_velocity = 0.0;
  rotor_axis_body = axis_body;
  if (motor) motor->rate = 0.0;
  for (JointAxis& axis : axes) axis.turned = axis.force = 0.0;
}

void Joint::state(StateArchive& archive) {
  archive(rotor_position, rotor_velocity, rotor_axis_body, motor);
  for (JointAxis& axis : axes) archive(axis.turned, axis.force);
}

}  // namespace trident::sim
