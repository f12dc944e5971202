// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "hull_params.h"
#include "trident_base/se3.h"
#include "trident_base/vehicle/rudder_params.h"
#include "trident_base/vehicle/thruster_params.h"
#include "trident_base/yaml_config.h"
#include "vessel_matrices.h"

namespace trident::sim {

/// The body axes that a parameter file is written in; inside of the simulator they are always FLU.
enum class BodyAxes { kFlu, kFrd };
constexpr auto enum_names(BodyAxes) {
  return std::array{EnumName{BodyAxes::kFlu, "flu"}, EnumName{BodyAxes::kFrd, "frd"}};
}

/// kFossen: M nu_dot + C nu + D nu_r = tau, solved as one. kLegacyVrx: what VRX's plugin applies, a
/// force of its own without Coriolis terms, with added mass from differences of the velocity.
enum class VesselEquation { kFossen, kLegacyVrx };
constexpr auto enum_names(VesselEquation) {
  return std::array{EnumName{VesselEquation::kFossen, "fossen"},
                    EnumName{VesselEquation::kLegacyVrx, "legacy_vrx"}};
}

/// A 6 x 6 matrix row by row.
using MatrixRows = std::array<double, 36>;

/// Drag across the hull by strip theory:
/// dY = -1/2 rho draft coefficient |v_r + x r| (v_r + x r) dx over the length. Off at length 0.
struct CrossFlowParams {
  double length_m = 0.0;
  double draft_m = 0.0;
  double coefficient = 0.0;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("length", length_m, Range::non_negative(), "of the hull, CO amidships [m]");
    ar.field("draft", draft_m, Range::non_negative(), "of all hulls that count [m]");
    ar.field("coefficient", coefficient, Range::non_negative(), "2D drag, e.g. Hoerner's curve");
  }
};

/// What a vessel is, as config/vessels/*.yaml says it. Coefficients of added mass and damping have
/// the sign that makes them positive for a real hull.
struct VesselParams {
  std::string name;
  BodyAxes axes = BodyAxes::kFlu;
  VesselEquation equation = VesselEquation::kFossen;
  bool munk = true;
  double water_density = 1025.0;
  double mass = 0.0;
  Eigen::Vector3d center_of_gravity = Eigen::Vector3d::Zero();
  Eigen::Vector3d inertia = Eigen::Vector3d::Zero();
  Eigen::Vector3d products_of_inertia = Eigen::Vector3d::Zero();
  Vector6d added_mass = Vector6d::Zero();
  std::optional<MatrixRows> added_mass_matrix;
  Vector6d linear_damping = Vector6d::Zero();
  std::optional<MatrixRows> linear_damping_matrix;
  Vector6d quadratic_damping = Vector6d::Zero();
  std::optional<MatrixRows> quadratic_damping_matrix;
  CrossFlowParams cross_flow;
  Eigen::Vector3d wind = Eigen::Vector3d::Zero();
  HullParams hull;
  std::vector<ThrusterParams> thrusters;
  std::vector<RudderParams> rudders;

  template <class Archive>
  void visit(Archive& ar) {
    ar.required("name", name, "how errors call it");
    ar.field("axes", axes, "of every vector and matrix here; frd: Fossen's, z down");
    ar.field("equation", equation, "of motion");
    ar.field("munk", munk, "false: the four Munk terms of C_A are zero");
    ar.field("water_density", water_density, Range::positive(), "[kg/m^3]");
    ar.required("mass", mass, Range::positive(), "[kg]");
    ar.field("center_of_gravity", center_of_gravity, "from CO [m]");
    ar.required("inertia", inertia, Range::positive(), "Ixx, Iyy, Izz about CG [kg m^2]");
    ar.field("products_of_inertia", products_of_inertia,
             "Ixy, Ixz, Iyz, the tensor's elements [kg m^2]");
    ar.field("added_mass", added_mass,
             "-X_udot, -Y_vdot, -Z_wdot, -K_pdot, -M_qdot, -N_rdot [kg, kg m^2]");
    ar.field("added_mass_matrix", added_mass_matrix, "in its place, row by row");
    ar.field("linear_damping", linear_damping, Range::non_negative(),
             "-X_u .. -N_r [N s/m, N m s]");
    ar.field("linear_damping_matrix", linear_damping_matrix, "in its place, row by row");
    ar.field("quadratic_damping", quadratic_damping, Range::non_negative(),
             "-X_u|u| .. -N_r|r| [N s^2/m^2, N m s^2]");
    ar.field("quadratic_damping_matrix", quadratic_damping_matrix,
             "in its place, row by row; column j is multiplied by |nu_j|");
    ar.field("cross_flow", cross_flow, "drag across the hull");
    ar.field("wind", wind, Range::non_negative(),
             "VRX' coefficients: force C_x u|u|, C_y v|v|, moment -2 C_z u v of the apparent wind");
    ar.field("hull", hull, "what the water carries");
    ar.field("thrusters", thrusters, "propellers");
    ar.field("rudders", rudders, "behind the hull");
  }
  /// Throws Error: a diagonal in addition to its matrix, two thrusters of one name.
  void validate() const;

  /// In FLU, whatever `axes` says.
  RigidBody rigid_body() const;
  Matrix6d added_mass_flu() const;
  Matrix6d linear_damping_flu() const;
  Matrix6d quadratic_damping_flu() const;
};

/// The vessel of a file, its own axes turned into FLU (`axes` is then kFlu). Throws ConfigError.
VesselParams load_vessel(const std::string& path);
/// The same vessel in FLU.
VesselParams in_flu(const VesselParams& vessel);

}  // namespace trident::sim
