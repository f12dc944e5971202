// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "vessel_dynamics.h"

#include <Eigen/LU>
#include <cmath>

#include "trident_base/error.h"
#include "trident_base/random_stream.h"
#include "trident_base/string_util.h"

namespace trident::sim {
namespace {

constexpr int kStrips = 20;

/// (w x v, 0): what separates nu_dot from the inertial acceleration in body axes.
Vector6d transport(const Eigen::Vector3d& w, const Vector6d& nu) {
  Vector6d result = Vector6d::Zero();
  result.head<3>() = w.cross(nu.head<3>());
  return result;
}

std::string vector_text(const Vector6d& v) {
  std::string text = "(";
  for (int i = 0; i < 6; ++i) text += (i > 0 ? ", " : "") + number_text(v[i]);
  return text + ")";
}

}  // namespace

VesselDynamics::VesselDynamics(const VesselParams& vessel)
    : name_(vessel.name),
      body_(vessel.rigid_body()),
      munk_(vessel.munk ? MunkMoment::kKeep : MunkMoment::kNeglect),
      M_rb_(trident::sim::rigid_body_mass(body_)),
      M_a_(vessel.added_mass_flu()),
      D_linear_(vessel.linear_damping_flu()),
      D_quadratic_(vessel.quadratic_damping_flu()),
      cross_flow_(vessel.cross_flow),
      density_(vessel.water_density) {
  check(vessel);
}

void VesselDynamics::check(const VesselParams& vessel) const {
  check_positive_definite(name_, "mass matrix M_RB", M_rb_);
  check_symmetric(name_, "added mass M_A", M_a_);
  check_positive_definite(name_, "mass matrix M_RB + M_A", M_rb_ + M_a_);
  check_dissipative(name_, "linear damping", D_linear_);
  // A diagonal of coefficients >= 0 takes energy at any velocity. Of a full quadratic matrix, whose
  // sign depends on the velocity, many directions and speeds are tried.
  const RandomStream stream(0, "trials of damping");
  for (std::uint64_t k = 0; k < 4000; ++k) {
    Vector6d nu;
    for (int i = 0; i < 6; ++i) nu[i] = stream.normal(k, static_cast<std::uint32_t>(i));
    nu *= 1e-2 * std::pow(10.0, 3.0 * stream.uniform(k, 6));
    const double power = nu.dot(damping(nu) * nu);
    if (!(power >= 0.0)) {
      throw Error("vessel '" + name_ + "': quadratic damping must be dissipative: at nu = " +
                  vector_text(nu) + " it gives " + number_text(-power) + " W, legal is <= 0");
    }
    check_skew(name_, "Coriolis matrix C_A", added_mass_coriolis(nu));
    if (!vessel.quadratic_damping_matrix && k > 20) return;
  }
}

Matrix6d VesselDynamics::cross_flow(const Vector6d& nu_r) const {
  Matrix6d D = Matrix6d::Zero();
  if (cross_flow_.length_m <= 0.0) return D;
  const double dx = cross_flow_.length_m / kStrips;
  const double scale = 0.5 * density_ * cross_flow_.draft_m * cross_flow_.coefficient * dx;
  for (int i = 0; i < kStrips; ++i) {
    const double x = -0.5 * cross_flow_.length_m + (i + 0.5) * dx;
    // Strip theory: each strip has the drag of its own sway velocity, v + x r.
    const double d = scale * std::abs(nu_r[1] + x * nu_r[5]);
    D(1, 1) += d;
    D(1, 5) += d * x;
    D(5, 5) += d * x * x;
  }
  D(5, 1) = D(1, 5);
  return D;
}

Matrix6d VesselDynamics::damping(const Vector6d& nu_r) const {
  Matrix6d D = D_linear_ + cross_flow(nu_r);
  D += D_quadratic_ * nu_r.cwiseAbs().asDiagonal();
  return D;
}

Matrix6d VesselDynamics::added_mass_coriolis(const Vector6d& nu_r) const {
  return trident::sim::added_mass_coriolis(M_a_, nu_r, munk_);
}

Vector6d VesselDynamics::centripetal(const Eigen::Vector3d& w) const {
  Vector6d result;
  result << body_.mass_kg * w.cross(w.cross(body_.center_of_gravity)),
      w.cross(body_.inertia_co() * w);
  return result;
}

Vector6d VesselDynamics::acceleration(const Vector6d& nu, const HullWater& water,
                                      const Vector6d& tau, double dt_s) const {
  const Vector6d nu_r = nu - water.velocity;
  const Matrix6d N = added_mass_coriolis(nu_r) + damping(nu_r);
  // nu_r_dot = a - carried; over the step nu_r becomes nu_r + dt (a - carried).
  const Eigen::Vector3d w = nu.tail<3>();
  const Vector6d carried = water.acceleration + transport(w, nu_r);
  const Vector6d rhs = tau - centripetal(w) - N * (nu_r - dt_s * carried) + M_a_ * carried;
  // Implicit in damping and Coriolis forces: light hulls with much damping stay stable.
  const Matrix6d A = M_rb_ + M_a_ + dt_s * N;
  return A.partialPivLu().solve(rhs);
}

Vector6d VesselDynamics::nu_dot(const Vector6d& nu, const HullWater& water, const Vector6d& tau,
                                double dt_s) const {
  return acceleration(nu, water, tau, dt_s) - transport(nu.tail<3>(), nu);
}

Vector6d VesselDynamics::engine_wrench(const Vector6d& nu, const HullWater& water,
                                       const Vector6d& tau, const Vector6d& tau_engine,
                                       double dt_s) const {
  const Vector6d a = acceleration(nu, water, tau, dt_s);
  // The engine knows M_RB only. What is still to be applied makes up for added mass and damping.
  return M_rb_ * a + centripetal(nu.tail<3>()) - tau_engine;
}

Vector6d about_center_of_gravity(const Vector6d& wrench_co, const Eigen::Vector3d& r_cg) {
  Vector6d result = wrench_co;
  result.tail<3>() -= r_cg.cross(wrench_co.head<3>());
  return result;
}

Vector6d wind_wrench(const Eigen::Vector3d& coefficients, const Eigen::Vector3d& apparent_wind) {
  const double u = apparent_wind.x(), v = apparent_wind.y();
  Vector6d result = Vector6d::Zero();
  result[0] = coefficients.x() * u * std::abs(u);
  result[1] = coefficients.y() * v * std::abs(v);
  // VRX' yaw moment, in axes with y to the left.
  result[5] = -2.0 * coefficients.z() * u * v;
  return result;
}

LegacyVrxForce::LegacyVrxForce(const VesselParams& vessel)
    : added_mass_(vessel.added_mass_flu().diagonal()),
      linear_(vessel.linear_damping_flu().diagonal()),
      quadratic_(vessel.quadratic_damping_flu().diagonal()) {}

Vector6d LegacyVrxForce::wrench(const Vector6d& nu, double dt_s) {
  const Vector6d nu_dot = (nu - nu_last_) / dt_s;
  nu_last_ = nu;
  return -added_mass_.cwiseProduct(nu_dot) -
         (linear_ + quadratic_.cwiseProduct(nu.cwiseAbs())).cwiseProduct(nu);
}

}  // namespace trident::sim
