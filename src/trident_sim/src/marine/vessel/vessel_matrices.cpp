// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "vessel_matrices.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "trident_base/error.h"
#include "trident_base/so3.h"
#include "trident_base/string_util.h"

namespace trident::sim {
namespace {

/// Rounding that a matrix written with a few digits may show, as a part of its largest element.
constexpr double kTolerance = 1e-9;

/// About x: axes y and z, and moments about them, change their sign.
Vector6d half_turn() {
  Vector6d signs;
  signs << 1, -1, -1, 1, -1, -1;
  return signs;
}

std::string subject(const std::string& vessel, const std::string& name) {
  return "vessel '" + vessel + "': " + name;
}

/// Throws when matrix(i, j) is not sign * matrix(j, i) for some i, j.
void check_mirrored(const std::string& vessel, const std::string& name, const Matrix6d& matrix,
                    double sign, const std::string& what) {
  const double tolerance = kTolerance * matrix.cwiseAbs().maxCoeff();
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j <= i; ++j) {
      const double wanted = sign * matrix(j, i);
      // The negation is true of NaN, too.
      if (!(std::abs(matrix(i, j) - wanted) <= tolerance)) {
        throw Error(subject(vessel, name) + " must be " + what + ": element (" +
                    std::to_string(i + 1) + ", " + std::to_string(j + 1) +
                    ") = " + number_text(matrix(i, j)) + ", legal is " + number_text(wanted));
      }
    }
  }
}

double smallest_eigenvalue(const Matrix6d& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Matrix6d>(symmetric, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .minCoeff();
}

}  // namespace

Eigen::Vector3d flu_from_frd(const Eigen::Vector3d& v) {
  return v.cwiseProduct(half_turn().head<3>());
}

Vector6d flu_from_frd(const Vector6d& v) { return v.cwiseProduct(half_turn()); }

Eigen::Matrix3d flu_from_frd(const Eigen::Matrix3d& tensor) {
  const Eigen::Vector3d signs = half_turn().head<3>();
  return signs.asDiagonal() * tensor * signs.asDiagonal();
}

Matrix6d flu_from_frd(const Matrix6d& matrix) {
  return half_turn().asDiagonal() * matrix * half_turn().asDiagonal();
}

Eigen::Matrix3d RigidBody::inertia_co() const {
  // Steiner's theorem, I_CO = I_CG - m S(r)^2.
  const Eigen::Matrix3d S = skew(center_of_gravity);
  return inertia_cg - mass_kg * S * S;
}

Matrix6d rigid_body_mass(const RigidBody& body) {
  const Eigen::Matrix3d S = skew(body.center_of_gravity);
  Matrix6d M;
  M << body.mass_kg * Eigen::Matrix3d::Identity(), -body.mass_kg * S,  //
      body.mass_kg * S, body.inertia_co();
  return M;
}

Matrix6d rigid_body_coriolis(const RigidBody& body, const Vector6d& nu) {
  // The parametrization without linear velocity, which holds in a steady current as it is.
  const Eigen::Vector3d w = nu.tail<3>();
  const Eigen::Matrix3d S_w = skew(w);
  const Eigen::Matrix3d S_g = skew(body.center_of_gravity);
  Matrix6d C;
  C << body.mass_kg * S_w, -body.mass_kg * S_w * S_g,  //
      body.mass_kg * S_g * S_w, -skew(body.inertia_co() * w);
  return C;
}

Matrix6d added_mass_coriolis(const Matrix6d& added_mass, const Vector6d& nu_r, MunkMoment munk) {
  const Vector6d momentum = added_mass * nu_r;
  const Eigen::Matrix3d S = skew(momentum.head<3>());
  Matrix6d C;
  C << Eigen::Matrix3d::Zero(), -S, -S, -skew(momentum.tail<3>());
  // Surge and sway in the yaw moment, and its counterpart, so that the matrix stays skew-symmetric.
  if (munk == MunkMoment::kNeglect) {
    C.block<2, 1>(0, 5).setZero();
    C.block<1, 2>(5, 0).setZero();
  }
  return C;
}

void check_symmetric(const std::string& vessel, const std::string& name, const Matrix6d& matrix) {
  check_mirrored(vessel, name, matrix, 1.0, "symmetric");
}

void check_skew(const std::string& vessel, const std::string& name, const Matrix6d& matrix) {
  check_mirrored(vessel, name, matrix, -1.0, "skew-symmetric");
}

void check_positive_definite(const std::string& vessel, const std::string& name,
                             const Matrix6d& matrix) {
  check_symmetric(vessel, name, matrix);
  const double smallest = smallest_eigenvalue(matrix);
  if (!(smallest > 0.0)) {
    throw Error(subject(vessel, name) + " must be positive definite: its smallest eigenvalue is " +
                number_text(smallest) + ", legal is > 0");
  }
}

void check_dissipative(const std::string& vessel, const std::string& name, const Matrix6d& matrix) {
  if (!matrix.allFinite()) throw Error(subject(vessel, name) + " must be finite");
  // nu' D nu is that of the symmetric part alone.
  const double smallest = smallest_eigenvalue(0.5 * (matrix + matrix.transpose()));
  if (!(smallest >= -kTolerance * matrix.cwiseAbs().maxCoeff())) {
    throw Error(subject(vessel, name) +
                " must be dissipative: the smallest eigenvalue of its symmetric part is " +
                number_text(smallest) + ", legal is >= 0");
  }
}

}  // namespace trident::sim
