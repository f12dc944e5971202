// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "rotor_axis.h"

#include <algorithm>

namespace trident::sim {
namespace {

/// Two rotors side by side, for vector instructions: a vehicle's rotors are most of what the engine
/// does for it. Each is worked out as it would be alone, to the last bit.
using Pair = Eigen::Array2d;
struct PairVector {
  Pair x, y, z;

  PairVector() = default;
  PairVector(Pair x, Pair y, Pair z) : x(std::move(x)), y(std::move(y)), z(std::move(z)) {}
  PairVector(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
      : x(a.x(), b.x()), y(a.y(), b.y()), z(a.z(), b.z()) {}

  Eigen::Vector3d of(Eigen::Index rotor) const { return {x[rotor], y[rotor], z[rotor]}; }
  PairVector cross(const PairVector& b) const {
    return {y * b.z - z * b.y, z * b.x - x * b.z, x * b.y - y * b.x};
  }
  Pair squared_norm() const { return x * x + (y * y + z * z); }  // in Eigen's order
};

PairVector operator+(const PairVector& a, const PairVector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
PairVector operator*(const Pair& a, const PairVector& b) { return {a * b.x, a * b.y, a * b.z}; }

/// Turns v by the rotation with which ODE moves a body that turns at w, 2 half = dt w: the
/// quaternion (1, half), normalised.
PairVector step_turned(const PairVector& half, const PairVector& v) {
  const PairVector across = half.cross(v);
  return v + (2.0 / (1.0 + half.squared_norm())) * (across + half.cross(across));
}

void advance_pair(Joint& a, Joint& b, const Eigen::Vector3d& w_body, double erp, double dt_s) {
  const PairVector axis(a.rotor_axis_body, b.rotor_axis_body), hinge(a.axis_body, b.axis_body);
  const PairVector w_carrier(w_body, w_body);
  const Pair spin(a.rotor_velocity, b.rotor_velocity);
  const PairVector w_rotor =
      w_carrier + spin * axis + Pair::Constant(erp / dt_s) * axis.cross(hinge);
  PairVector turned = step_turned(Pair::Constant(0.5 * dt_s) * w_rotor, axis);
  turned = step_turned(Pair::Constant(-0.5 * dt_s) * w_carrier, turned);
  const Pair length = turned.squared_norm().sqrt();
  turned = {turned.x / length, turned.y / length, turned.z / length};
  a.rotor_axis_body = turned.of(0);
  b.rotor_axis_body = turned.of(1);
}

}  // namespace

Eigen::Vector3d rotor_axis_reaction(const Joint& joint, double erp, double dt_s) {
  return -joint.rotor_inertia.transverse * erp / (dt_s * dt_s) *
         joint.rotor_axis_body.cross(joint.axis_body);
}

void advance_rotor_axes(Span<Joint* const> joints, const Eigen::Vector3d& w_body, double erp,
                        double dt_s) {
  for (std::size_t i = 0; i < joints.size(); i += 2) {
    // The last of an odd number is worked out twice.
    Joint& second = *joints[std::min(i + 1, joints.size() - 1)];
    advance_pair(*joints[i], second, w_body, erp, dt_s);
  }
}

}  // namespace trident::sim
