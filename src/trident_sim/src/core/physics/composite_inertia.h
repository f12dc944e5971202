// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/physics/engine_body.h"
#include "trident_sim/model_spec.h"

namespace trident::sim {

/// A link of a body. `rotor_axis`: the axis, model frame, about which a motor turns it as a rotor;
/// nullptr when none does.
struct BodyPart {
  const LinkSpec* link;
  const Eigen::Vector3d* rotor_axis;
};

/// Links that move as one, in the frame of their model.
struct CompositeInertia {
  double mass_kg = 0.0;
  Eigen::Vector3d p_model_com = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();         ///< [kg m^2] about p_model_com
  double weight_kg = 0.0;                                    ///< of the links that gravity pulls
  Eigen::Vector3d p_model_weight = Eigen::Vector3d::Zero();  ///< their centre of mass
};

/// A rotor loads its carrier across its axis only: about the axis it is free.
CompositeInertia compose_inertia(const std::vector<BodyPart>& parts);

/// Of the links that a rotor joint turns.
RotorInertia rotor_inertia(const LinkSpec& link, const Eigen::Vector3d& rotor_axis);

/// Gives `body`, whose axes are turned by R_model_body, and its ODE body the inertia.
void set_inertia(EngineBody& body, const CompositeInertia& inertia,
                 const Eigen::Quaterniond& R_model_body);

}  // namespace trident::sim
