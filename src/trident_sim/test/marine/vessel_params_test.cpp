// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "marine/vessel/vessel_params.h"

#include <gtest/gtest.h>

#include "marine/vessel/thruster.h"
#include "standalone_vessel.h"
#include "test_world.h"

namespace trident::sim {
namespace {

constexpr const char* kBoat = "name: boat\nmass: 80\ninertia: [16, 21, 15]\n";

VesselParams boat(const std::string& more) {
  return load_yaml_string<VesselParams>(kBoat + more, "boat.yaml");
}

class ShippedVessel : public testing::TestWithParam<const char*> {};

TEST_P(ShippedVessel, LoadsFloatsLevelAndItsThrustersPush) {
  const VesselParams params = shipped_vessel(GetParam());
  const VesselDynamics dynamics(params);
  const Hull hull(params.hull, params.water_density, 9.81);
  const StaticPose rest = hull.rest(params.mass, dynamics.rigid_body().center_of_gravity);
  EXPECT_NEAR(rest.z_m, 0.0, 1e-3);
  EXPECT_NEAR(rest.pitch_rad, 0.0, 2e-3);
  const double z_cg = dynamics.rigid_body().center_of_gravity.z();
  EXPECT_GT(hull.hydrostatics().gm_transverse_m(z_cg), 0.0);
  ASSERT_EQ(params.thrusters.size(), 2U);
  for (const ThrusterParams& thruster : params.thrusters) {
    EXPECT_GT(thrust_at(thruster, thruster.max_command), 0.0) << thruster.name;
    EXPECT_LT(thrust_at(thruster, thruster.min_command), 0.0) << thruster.name;
  }
  // FLU: the left one lies to the left.
  EXPECT_EQ(params.thrusters[0].name, "left");
  EXPECT_GT(params.thrusters[0].position.y(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedVessel,
                         testing::Values("otter", "wamv", "heron", "small_catamaran"));

/// INTERFACES of the published model, PythonVehicleSimulator's otter.py.
TEST(Otter, FiguresAreThoseOfTheModel) {
  const VesselParams params = shipped_vessel("otter");
  const VesselDynamics otter(params);
  const Matrix6d M = otter.rigid_body_mass() + otter.added_mass();
  const double diagonal[] = {85.5, 162.5, 135.0, 24.89, 45.48, 42.65};
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(M(i, i) / diagonal[i], 1.0, 1e-3) << i;
  // In Fossen's axes M15 = -19.75, M26 = 12.25.
  const Matrix6d M_frd = flu_from_frd(M);
  EXPECT_NEAR(M_frd(0, 4), -19.75, 0.01);
  EXPECT_NEAR(M_frd(1, 5), 12.25, 0.01);

  const Hydrostatics h = Hull(params.hull, params.water_density, 9.81).hydrostatics();
  const double z_cg = otter.rigid_body().center_of_gravity.z();
  EXPECT_NEAR(z_cg, 0.2469, 1e-3);
  EXPECT_NEAR(h.displaced_m3 / (80.0 / 1025.0), 1.0, 0.01);
  EXPECT_NEAR(h.waterplane_m2 / 0.75, 1.0, 0.01);
  EXPECT_NEAR(h.gm_transverse_m(z_cg) / 1.2325, 1.0, 0.01);
  EXPECT_NEAR(h.gm_longitudinal_m(z_cg) / 3.1113, 1.0, 0.01);
  const double weight = 1025.0 * 9.81 * h.displaced_m3;
  EXPECT_NEAR(1025.0 * 9.81 * h.waterplane_m2 / 7541.0, 1.0, 0.01);
  EXPECT_NEAR(weight * h.gm_transverse_m(z_cg) / 967.3, 1.0, 0.01);
  EXPECT_NEAR(weight * h.gm_longitudinal_m(z_cg) / 2441.7, 1.0, 0.01);
  EXPECT_NEAR(params.hull.sections[0].draft / 0.195, 1.0, 0.01);

  const Thruster left(params.thrusters[0]);
  EXPECT_NEAR(thrust_at(left.params(), 103.93), 119.7, 0.1);
  EXPECT_NEAR(thrust_at(left.params(), -101.74), -66.7, 0.1);
}

TEST(VesselParams, FossensAxesBecomeFlu) {
  const VesselParams frd = boat(
      "axes: frd\ncenter_of_gravity: [0.1, 0.2, 0.3]\nproducts_of_inertia: [1, 2, 3]\n"
      "thrusters: [{name: t, position: [-1, 0.4, 0.1], yaw: 0.5}]\n");
  const VesselParams flu = in_flu(frd);
  EXPECT_EQ(flu.center_of_gravity, Eigen::Vector3d(0.1, -0.2, -0.3));
  const RigidBody body = frd.rigid_body();
  Eigen::Matrix3d tensor;
  tensor << 16, 1, 2, 1, 21, 3, 2, 3, 15;
  EXPECT_LT((body.inertia_cg - flu_from_frd(tensor)).norm(), 1e-12);
  EXPECT_EQ(flu.thrusters[0].position, Eigen::Vector3d(-1, -0.4, -0.1));
  EXPECT_EQ(flu.thrusters[0].yaw, -0.5);
  EXPECT_EQ(in_flu(flu).center_of_gravity, flu.center_of_gravity);
}

TEST(VesselParams, FullMatrixIsTurnedWhole) {
  std::string rows = "axes: frd\nadded_mass_matrix: [";
  for (int i = 0; i < 36; ++i) {
    const bool coupled = i == 1 * 6 + 3 || i == 3 * 6 + 1;  // sway and roll
    const bool kept = i == 1 * 6 + 5 || i == 5 * 6 + 1;     // sway and yaw
    rows += std::string(i % 7 == 0 ? "9" : coupled || kept ? "2" : "0") + (i < 35 ? "," : "]\n");
  }
  const Matrix6d M = boat(rows).added_mass_flu();
  EXPECT_EQ(M(1, 3), -2.0);
  EXPECT_EQ(M(1, 5), 2.0);
  EXPECT_EQ(M(4, 4), 9.0);
}

TEST(VesselParams, BadInputIsNamed) {
  const auto refusal = [](const std::string& more) { return error_of([&] { boat(more); }); };
  EXPECT_TRUE(contains(refusal("draught: 1\n"), "boat.yaml:4: draught: "));
  EXPECT_TRUE(contains(refusal("munk: 3\n"), "munk"));
  EXPECT_TRUE(contains(refusal("water_density: -1\n"), "boat.yaml:4: water_density: -1"));
  EXPECT_TRUE(contains(refusal("linear_damping: [1, 1, -1, 1, 1, 1]\n"), "linear_damping[2]"));
  EXPECT_TRUE(contains(refusal("equation: fosen\n"), "fossen"));
  EXPECT_TRUE(contains(refusal("hull: {sections: [{x: 0, length: 1, breadth: 0, draft: 1}]}\n"),
                       "hull.sections[0].breadth"));
  EXPECT_TRUE(contains(refusal("thrusters: [{name: a, position: [0, 0, 0]}, {name: a, position: "
                               "[0, 0, 0]}]\n"),
                       "the name 'a' is there twice"));
  EXPECT_TRUE(contains(
      refusal("thrusters: [{name: a, position: [0, 0, 0], mapping: table, table_commands: [0, 0], "
              "table_forces: [1, 2]}]\n"),
      "table_commands[1] = 0 must be above"));
}

TEST(VesselParams, MatricesAreChecked) {
  VesselParams params = boat("");
  params.added_mass << 0, -100, 0, 0, 0, 0;
  EXPECT_TRUE(contains(error_of([&] { VesselDynamics{params}; }),
                       "vessel 'boat': mass matrix M_RB + M_A must be positive definite: its "
                       "smallest eigenvalue is -20"));
  params = boat("products_of_inertia: [0, 60, 0]\n");
  EXPECT_TRUE(contains(error_of([&] { VesselDynamics{params}; }), "mass matrix M_RB must be"));

  MatrixRows rows{};
  for (std::size_t i = 0; i < 6; ++i) rows[7 * i] = 1.0;
  rows[1] = 4.0;  // row 1, column 2
  params = boat("");
  params.linear_damping_matrix = rows;
  EXPECT_TRUE(
      contains(error_of([&] { VesselDynamics{params}; }), "'boat': linear damping must be"));
  params = boat("");
  params.quadratic_damping_matrix = rows;
  EXPECT_TRUE(
      contains(error_of([&] { VesselDynamics{params}; }), "quadratic damping must be dissipative"));
  rows[1] = 0.0;
  params.quadratic_damping_matrix = rows;
  const VesselDynamics dynamics(params);
  EXPECT_EQ(dynamics.damping(Vector6d::Constant(-2.0))(3, 3), 2.0);
}

}  // namespace
}  // namespace trident::sim
