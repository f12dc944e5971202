// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "composite_inertia.h"

#include <algorithm>

namespace trident::sim {
namespace {

Eigen::Matrix3d about_origin(double mass, const Eigen::Vector3d& p) {
  return mass * (p.squaredNorm() * Eigen::Matrix3d::Identity() - p * p.transpose());
}

/// About the link's own centre of mass, model axes.
Eigen::Matrix3d link_inertia(const LinkSpec& link) {
  const Eigen::Matrix3d R = (link.T_model_link.R * link.inertial.T_link_com.R).toRotationMatrix();
  return R * link.inertial.inertia_com * R.transpose();
}

/// A rotor seen from its carrier: free about its axis, so that inertia does not load the carrier,
/// and round, because it turns many times in the time in which the carrier moves.
Eigen::Matrix3d part_inertia(const BodyPart& part) {
  if (part.rotor_axis == nullptr) return link_inertia(*part.link);
  const Eigen::Matrix3d inertia = link_inertia(*part.link);
  const Eigen::Vector3d& axis = *part.rotor_axis;
  const double transverse = 0.5 * (inertia.trace() - axis.dot(inertia * axis));
  return transverse * (Eigen::Matrix3d::Identity() - axis * axis.transpose());
}

Eigen::Vector3d p_model_com_of(const LinkSpec& link) {
  return link.T_model_link * link.inertial.T_link_com.p;
}

}  // namespace

CompositeInertia compose_inertia(const std::vector<BodyPart>& parts) {
  CompositeInertia result;
  Eigen::Vector3d weighted = Eigen::Vector3d::Zero(), pulled = Eigen::Vector3d::Zero();
  for (const BodyPart& part : parts) {
    const double mass = part.link->inertial.mass_kg;
    result.mass_kg += mass;
    weighted += mass * p_model_com_of(*part.link);
    if (!part.link->gravity) continue;
    result.weight_kg += mass;
    pulled += mass * p_model_com_of(*part.link);
  }
  result.p_model_com = weighted / result.mass_kg;
  // Where all or none are pulled there is no lever, to the last bit.
  const bool has_lever = std::any_of(parts.begin(), parts.end(), [&](const BodyPart& part) {
    return part.link->gravity != parts.front().link->gravity;
  });
  result.p_model_weight =
      has_lever ? Eigen::Vector3d(pulled / result.weight_kg) : result.p_model_com;
  for (const BodyPart& part : parts) {
    const Eigen::Vector3d p = p_model_com_of(*part.link) - result.p_model_com;
    result.inertia += part_inertia(part) + about_origin(part.link->inertial.mass_kg, p);
  }
  return result;
}

RotorInertia rotor_inertia(const LinkSpec& link, const Eigen::Vector3d& rotor_axis) {
  const double axial = rotor_axis.dot(link_inertia(link) * rotor_axis);
  return {axial, 0.5 * (link.inertial.inertia_com.trace() - axial)};
}

void set_inertia(EngineBody& body, const CompositeInertia& inertia,
                 const Eigen::Quaterniond& R_model_body) {
  const Eigen::Matrix3d R = R_model_body.toRotationMatrix();
  body.composite.mass_kg = inertia.mass_kg;
  body.composite.inertia = R.transpose() * inertia.inertia * R;
  body.composite.inertia_inverse = body.composite.inertia.inverse();
  body.composite.weight_kg = inertia.weight_kg;
  body.composite.p_weight = R.transpose() * (inertia.p_model_weight - inertia.p_model_com);
  const Eigen::Matrix3d& I = body.composite.inertia;
  dMass mass;
  dMassSetParameters(&mass, body.composite.mass_kg, 0, 0, 0, I(0, 0), I(1, 1), I(2, 2), I(0, 1),
                     I(0, 2), I(1, 2));
  dBodySetMass(body.ode, &mass);
  if (body.kinematic) dBodySetKinematic(body.ode);  // which a mass ends
}

}  // namespace trident::sim
