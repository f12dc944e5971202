// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hull.h"
#include "trident_base/se3.h"
#include "vessel_params.h"

namespace trident::sim {

/// Forces on a vessel of six degrees of freedom (Fossen 2011, 6.1 and 8.3), about CO, body axes
/// FLU:
///
///   M_RB nu_dot + C_RB(nu) nu + M_A nu_r_dot + C_A(nu_r) nu_r + D(nu_r) nu_r = tau
///
/// nu_r is the velocity relative to the water, which a uniform current and the orbital motion of
/// waves move. The engine that moves bodies knows M_RB only and adds its own gyroscopic torque.
/// Added mass is therefore solved for together with the rigid body's (never fed back as a force of
/// a past acceleration), and the engine is handed the wrench by which its own M_RB reaches the same
/// acceleration. What the engine adds within the step is not in that wrench: contacts and joints
/// act on M_RB alone.
///
/// `acceleration` is the inertial one in body axes, a = nu_dot + (w x v, 0): it and the terms of
/// M_RB in it depend on the angular velocity only, so that a uniform current carries every path
/// along exactly (Fossen 2011, 8.145-8.147).
class VesselDynamics {
 public:
  /// Checks the matrices: M_RB + M_A symmetric and positive definite, damping dissipative. Throws
  /// Error naming vessel, matrix and figure.
  explicit VesselDynamics(const VesselParams& vessel);

  const std::string& name() const { return name_; }
  const RigidBody& rigid_body() const { return body_; }
  const Matrix6d& rigid_body_mass() const { return M_rb_; }
  const Matrix6d& added_mass() const { return M_a_; }

  /// D(nu_r), linear, quadratic and cross-flow: the damping wrench is -D(nu_r) nu_r.
  Matrix6d damping(const Vector6d& nu_r) const;
  Matrix6d added_mass_coriolis(const Vector6d& nu_r) const;

  /// The acceleration a from all wrenches on the vessel, `tau`, but those of added mass and
  /// damping. With dt_s > 0 Coriolis and damping act on the velocity at the end of the step
  /// (linearly implicit), which keeps any damping stable at any step; dt_s = 0 gives the plain
  /// derivative.
  Vector6d acceleration(const Vector6d& nu, const HullWater& water, const Vector6d& tau,
                        double dt_s) const;
  /// nu_dot, for integrators that keep nu.
  Vector6d nu_dot(const Vector6d& nu, const HullWater& water, const Vector6d& tau,
                  double dt_s = 0.0) const;

  /// What to give the engine besides `tau_engine`, the part of `tau` that the engine has already
  /// (gravity, forces that others put on the body).
  Vector6d engine_wrench(const Vector6d& nu, const HullWater& water, const Vector6d& tau,
                         const Vector6d& tau_engine, double dt_s) const;

 private:
  void check(const VesselParams& vessel) const;
  /// M_RB's part that does not depend on the acceleration: C_RB(nu) nu of a body whose CO rests.
  Vector6d centripetal(const Eigen::Vector3d& w) const;
  Matrix6d cross_flow(const Vector6d& nu_r) const;

  std::string name_;
  RigidBody body_;
  MunkMoment munk_;
  Matrix6d M_rb_, M_a_;
  Matrix6d D_linear_, D_quadratic_;
  CrossFlowParams cross_flow_;
  double density_;
};

/// A wrench about CO in body axes as force and torque about the centre of gravity, body axes.
Vector6d about_center_of_gravity(const Vector6d& wrench_co, const Eigen::Vector3d& r_cg);

/// Of the wind on a hull, about CO, from the apparent wind in body axes (the air's velocity less
/// the boat's): C_x u|u|, C_y v|v|, moment -2 C_z u v. VRX takes the wind over ground.
Vector6d wind_wrench(const Eigen::Vector3d& coefficients, const Eigen::Vector3d& apparent_wind);

/// VRX' equation, for comparisons: F = -M_A (nu - nu_last) / dt - D(nu) nu on the velocity over
/// ground, without Coriolis. As there it diverges where added mass exceeds the mass.
class LegacyVrxForce {
 public:
  explicit LegacyVrxForce(const VesselParams& vessel);

  Vector6d wrench(const Vector6d& nu, double dt_s);
  void reset() { nu_last_.setZero(); }

  template <class Archive>
  void state(Archive& archive) {
    archive(nu_last_);
  }

 private:
  Vector6d added_mass_, linear_, quadratic_;
  Vector6d nu_last_ = Vector6d::Zero();
};

}  // namespace trident::sim
