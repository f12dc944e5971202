// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>

#include "trident_base/se3.h"

namespace trident::sim {

// Matrices of a vessel's equation of motion (Fossen, Handbook of Marine Craft Hydrodynamics and
// Motion Control, 2011). Inside of the simulator the body frame is that of REP 103: x forward, y
// left, z up, with its origin CO amidships in the still waterplane. Vectors of six are (linear,
// angular): nu = (v_CO [m/s], w [rad/s]), tau = (force [N], moment about CO [N m]).
//
// Fossen's figures are given for x forward, y right, z down. Both frames are right-handed and
// differ by half a turn about x, so the equations keep their form, and `flu_from_frd` converts the
// figures.

/// (x, y, z) -> (x, -y, -z); its own inverse, as all of these are.
Eigen::Vector3d flu_from_frd(const Eigen::Vector3d& v);
/// A twist or a wrench.
Vector6d flu_from_frd(const Vector6d& v);
/// A tensor of inertia.
Eigen::Matrix3d flu_from_frd(const Eigen::Matrix3d& tensor);
/// A matrix of mass or damping.
Matrix6d flu_from_frd(const Matrix6d& matrix);

/// What moves with the hull: `center_of_gravity` from CO [m], `inertia_cg` about it [kg m^2].
struct RigidBody {
  double mass_kg = 0.0;
  Eigen::Vector3d center_of_gravity = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia_cg = Eigen::Matrix3d::Zero();

  /// About CO, by the parallel-axes theorem, (3.36).
  Eigen::Matrix3d inertia_co() const;
};

/// M_RB about CO, (3.44).
Matrix6d rigid_body_mass(const RigidBody& body);

/// C_RB(nu) about CO in the form that depends on the angular velocity alone, (3.57); it is skew,
/// and with it nu may be replaced by the velocity relative to a uniform current (8.145-8.147).
Matrix6d rigid_body_coriolis(const RigidBody& body, const Vector6d& nu);

/// The four terms of C_A that turn a drifting hull across its path and what keeps C_A skew with
/// them: surge and sway against yaw.
enum class MunkMoment { kKeep, kNeglect };

/// C_A(nu_r) of an added-mass matrix, skew, (6.43).
Matrix6d added_mass_coriolis(const Matrix6d& added_mass, const Vector6d& nu_r,
                             MunkMoment munk = MunkMoment::kKeep);

/// Each check throws Error that names vessel, matrix, the element or eigenvalue and what is legal.
void check_symmetric(const std::string& vessel, const std::string& name, const Matrix6d& matrix);
/// Symmetric, and its smallest eigenvalue is > 0.
void check_positive_definite(const std::string& vessel, const std::string& name,
                             const Matrix6d& matrix);
/// nu' D nu >= 0: the smallest eigenvalue of the symmetric part is >= 0.
void check_dissipative(const std::string& vessel, const std::string& name, const Matrix6d& matrix);
void check_skew(const std::string& vessel, const std::string& name, const Matrix6d& matrix);

}  // namespace trident::sim
