// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "vessel_params.h"

#include <set>

namespace trident::sim {
namespace {

void check_one_of(const std::string& name, const Vector6d& diagonal,
                  const std::optional<MatrixRows>& matrix) {
  if (matrix && !diagonal.isZero(0.0)) {
    throw Error(name + " and " + name + "_matrix are both given; legal is one of them");
  }
}

Matrix6d matrix_of(const Vector6d& diagonal, const std::optional<MatrixRows>& rows) {
  if (!rows) return diagonal.asDiagonal();
  return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(rows->data());
}

std::optional<MatrixRows> turned(const std::optional<MatrixRows>& rows) {
  if (!rows) return rows;
  const Matrix6d flu = flu_from_frd(matrix_of(Vector6d::Zero(), rows));
  MatrixRows result;
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(result.data()) = flu;
  return result;
}

template <class Named>
void check_names(const std::string& list, const std::vector<Named>& items) {
  std::set<std::string> names;
  for (const Named& item : items) {
    if (!names.insert(item.name).second) {
      throw Error(list + ": the name '" + item.name + "' is there twice; legal is once");
    }
  }
}

}  // namespace

void VesselParams::validate() const {
  check_one_of("added_mass", added_mass, added_mass_matrix);
  check_one_of("linear_damping", linear_damping, linear_damping_matrix);
  check_one_of("quadratic_damping", quadratic_damping, quadratic_damping_matrix);
  check_names("thrusters", thrusters);
  check_names("rudders", rudders);
}

RigidBody VesselParams::rigid_body() const {
  const VesselParams flu = in_flu(*this);
  RigidBody body;
  body.mass_kg = flu.mass;
  body.center_of_gravity = flu.center_of_gravity;
  const Eigen::Vector3d& products = flu.products_of_inertia;
  body.inertia_cg << flu.inertia.x(), products.x(), products.y(),  //
      products.x(), flu.inertia.y(), products.z(),                 //
      products.y(), products.z(), flu.inertia.z();
  return body;
}

Matrix6d VesselParams::added_mass_flu() const {
  const VesselParams flu = in_flu(*this);
  return matrix_of(flu.added_mass, flu.added_mass_matrix);
}

Matrix6d VesselParams::linear_damping_flu() const {
  const VesselParams flu = in_flu(*this);
  return matrix_of(flu.linear_damping, flu.linear_damping_matrix);
}

Matrix6d VesselParams::quadratic_damping_flu() const {
  const VesselParams flu = in_flu(*this);
  return matrix_of(flu.quadratic_damping, flu.quadratic_damping_matrix);
}

VesselParams in_flu(const VesselParams& vessel) {
  VesselParams flu = vessel;
  if (vessel.axes == BodyAxes::kFlu) return flu;
  flu.axes = BodyAxes::kFlu;
  flu.center_of_gravity = flu_from_frd(vessel.center_of_gravity);
  // Ixy and Ixz change their sign, Iyz and the moments do not.
  flu.products_of_inertia.head<2>() *= -1.0;
  // A diagonal is the same in both axes, as signs cancel.
  flu.added_mass_matrix = turned(vessel.added_mass_matrix);
  flu.linear_damping_matrix = turned(vessel.linear_damping_matrix);
  flu.quadratic_damping_matrix = turned(vessel.quadratic_damping_matrix);
  for (double& y : flu.hull.offsets) y = -y;
  for (ThrusterParams& thruster : flu.thrusters) {
    thruster.position = flu_from_frd(thruster.position);
    thruster.yaw = -thruster.yaw;
  }
  for (RudderParams& rudder : flu.rudders) rudder.position = flu_from_frd(rudder.position);
  return flu;
}

VesselParams load_vessel(const std::string& path) { return in_flu(load_yaml<VesselParams>(path)); }

}  // namespace trident::sim
