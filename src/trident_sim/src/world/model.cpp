// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/model.h"

namespace trident {

double Joint::position() const {
  if (spun) return spun_position;
  if (ode == nullptr) return 0.0;
  return spec.type == JointType::kRevolute ? dJointGetHingeAngle(ode)
                                           : dJointGetSliderPosition(ode);
}

double Joint::velocity() const {
  if (spun) return spun_velocity;
  if (ode == nullptr || child->body == nullptr) return 0.0;
  const Eigen::Vector3d w_parent = parent ? parent->w_world() : Eigen::Vector3d::Zero();
  if (spec.type == JointType::kRevolute) {
    dVector3 axis;
    dJointGetHingeAxis(ode, axis);
    return (child->body->w_world - w_parent).dot(Eigen::Vector3d(axis[0], axis[1], axis[2]));
  }
  dVector3 axis;
  dJointGetSliderAxis(ode, axis);
  const Eigen::Vector3d p_world = child->p_world_com();
  const Eigen::Vector3d v_parent = parent ? parent->v_world_at(p_world) : Eigen::Vector3d::Zero();
  return (child->v_world_at(p_world) - v_parent).dot(Eigen::Vector3d(axis[0], axis[1], axis[2]));
}

void Joint::set_velocity(double rate) {
  if (spun) {
    spun_velocity = rate;
    return;
  }
  if (ode == nullptr || child->body == nullptr || spec.type != JointType::kRevolute) return;
  dVector3 axis;
  dJointGetHingeAxis(ode, axis);
  child->body->w_world += (rate - velocity()) * Eigen::Vector3d(axis[0], axis[1], axis[2]);
}

Link* Model::find_link(const std::string& link_name) const {
  for (const auto& link : links) {
    if (link->name == link_name) return link.get();
  }
  return nullptr;
}

Joint* Model::find_joint(const std::string& joint_name) const {
  for (const auto& joint : joints) {
    if (joint->spec.name == joint_name) return joint.get();
  }
  return nullptr;
}

SE3 Model::T_world_model() const {
  if (links.empty()) return T_world_model_initial;
  return links.front()->T_world_link() * spec.links.front().T_model_link.inverse();
}

}  // namespace trident
