// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "marine/vessel/vessel_matrices.h"

#include <gtest/gtest.h>

#include "marine_random.h"
#include "test_world.h"

namespace trident::sim {
namespace {

RigidBody lopsided_body() {
  RigidBody body;
  body.mass_kg = 80.0;
  body.center_of_gravity = {0.15, -0.03, 0.25};
  body.inertia_cg << 16.7, 0.3, -0.4, 0.3, 21.5, 0.2, -0.4, 0.2, 15.1;
  return body;
}

TEST(VesselMatrices, KineticEnergyOfTheRigidBodyIsThatOfItsCenterOfGravity) {
  const RigidBody body = lopsided_body();
  const Vector6d nu = random_vector6(1);
  const Eigen::Vector3d w = nu.tail<3>();
  const Eigen::Vector3d v_cg = nu.head<3>() + w.cross(body.center_of_gravity);
  const double energy = 0.5 * body.mass_kg * v_cg.squaredNorm() + 0.5 * w.dot(body.inertia_cg * w);
  EXPECT_NEAR(0.5 * nu.dot(rigid_body_mass(body) * nu), energy, 1e-9);
}

/// A force-free body: M_RB nu_dot + C_RB nu = 0 must be what Newton and Euler say about CG.
TEST(VesselMatrices, CoriolisOfTheRigidBodyIsNewtonsAndEulers) {
  const RigidBody body = lopsided_body();
  for (int k = 0; k < 20; ++k) {
    const Vector6d nu = random_vector6(k);
    const Vector6d nu_dot = random_vector6(100 + k);
    const Vector6d tau = rigid_body_mass(body) * nu_dot + rigid_body_coriolis(body, nu) * nu;
    const Eigen::Vector3d w = nu.tail<3>(), w_dot = nu_dot.tail<3>();
    const Eigen::Vector3d& r = body.center_of_gravity;
    const Eigen::Vector3d a_cg =
        nu_dot.head<3>() + w.cross(nu.head<3>()) + w_dot.cross(r) + w.cross(w.cross(r));
    const Eigen::Vector3d force = body.mass_kg * a_cg;
    const Eigen::Vector3d moment =
        body.inertia_cg * w_dot + w.cross(body.inertia_cg * w) + r.cross(force);
    EXPECT_LT((tau.head<3>() - force).norm(), 1e-9);
    EXPECT_LT((tau.tail<3>() - moment).norm(), 1e-9);
  }
}

/// Kirchhoff's equations in an ideal fluid, (6.38): with P, L = M_A nu,
/// d/dt P + w x P is the force and d/dt L + w x L + v x P the moment.
TEST(VesselMatrices, CoriolisOfTheAddedMassIsKirchhoffs) {
  const Matrix6d root = random_matrix6(3);
  const Matrix6d added_mass = root * root.transpose();
  const Vector6d nu = random_vector6(4);
  const Vector6d momentum = added_mass * nu;
  const Eigen::Vector3d v = nu.head<3>(), w = nu.tail<3>(), P = momentum.head<3>(),
                        L = momentum.tail<3>();
  const Vector6d tau = added_mass_coriolis(added_mass, nu) * nu;
  EXPECT_LT((tau.head<3>() - w.cross(P)).norm(), 1e-9);
  EXPECT_LT((tau.tail<3>() - (w.cross(L) + v.cross(P))).norm(), 1e-9);
}

TEST(VesselMatrices, CoriolisDoesNoWork) {
  const RigidBody body = lopsided_body();
  const Matrix6d root = random_matrix6(5);
  for (int k = 0; k < 100; ++k) {
    const Vector6d nu = 3.0 * random_vector6(k);
    check_skew("boat", "C_RB", rigid_body_coriolis(body, nu));
    for (const MunkMoment munk : {MunkMoment::kKeep, MunkMoment::kNeglect}) {
      check_skew("boat", "C_A", added_mass_coriolis(root * root.transpose(), nu, munk));
    }
  }
}

TEST(VesselMatrices, MunkMomentTurnsADriftingHullAcross) {
  Vector6d diagonal;
  diagonal << 5.5, 82.5, 55.0, 3.3, 17.2, 25.7;
  const Matrix6d added_mass = diagonal.asDiagonal();
  Vector6d nu = Vector6d::Zero();
  nu[0] = 2.0;
  nu[1] = 0.5;
  const Vector6d kept = added_mass_coriolis(added_mass, nu) * nu;
  EXPECT_NEAR(-kept[5], -(82.5 - 5.5) * 2.0 * 0.5, 1e-12);
  const Vector6d neglected = added_mass_coriolis(added_mass, nu, MunkMoment::kNeglect) * nu;
  EXPECT_EQ(neglected[5], 0.0);
}

TEST(VesselMatrices, FossensAxesAreTurnedAboutX) {
  EXPECT_EQ(flu_from_frd(Eigen::Vector3d(1, 2, 3)), Eigen::Vector3d(1, -2, -3));
  const RigidBody frd = lopsided_body();
  RigidBody flu = frd;
  flu.center_of_gravity = flu_from_frd(frd.center_of_gravity);
  flu.inertia_cg = flu_from_frd(frd.inertia_cg);
  EXPECT_LT((flu_from_frd(rigid_body_mass(frd)) - rigid_body_mass(flu)).norm(), 1e-12);

  const Vector6d nu = random_vector6(7);
  const Matrix6d root = random_matrix6(8);
  const Matrix6d added_mass = root * root.transpose();
  const Vector6d in_frd = (rigid_body_coriolis(frd, nu) + added_mass_coriolis(added_mass, nu)) * nu;
  const Vector6d nu_flu = flu_from_frd(nu);
  const Vector6d in_flu =
      (rigid_body_coriolis(flu, nu_flu) + added_mass_coriolis(flu_from_frd(added_mass), nu_flu)) *
      nu_flu;
  EXPECT_LT((flu_from_frd(in_frd) - in_flu).norm(), 1e-9);
}

TEST(VesselMatrices, RefusalsNameVesselMatrixAndFigure) {
  Matrix6d matrix = Matrix6d::Identity();
  check_positive_definite("otter", "M", matrix);
  matrix(1, 1) = -2.5;
  EXPECT_TRUE(contains(error_of([&] { check_positive_definite("otter", "M", matrix); }),
                       "vessel 'otter': M must be positive definite: its smallest eigenvalue is "
                       "-2.5, legal is > 0"));
  EXPECT_TRUE(contains(error_of([&] { check_dissipative("otter", "D", matrix); }),
                       "vessel 'otter': D must be dissipative"));
  matrix = Matrix6d::Identity();
  matrix(4, 0) = 0.25;
  EXPECT_TRUE(contains(error_of([&] { check_positive_definite("otter", "M", matrix); }),
                       "symmetric: element (5, 1) = 0.25, legal is 0"));
  EXPECT_TRUE(contains(error_of([&] { check_skew("otter", "C", matrix); }),
                       "element (1, 1) = 1, legal is -1"));
  matrix(3, 3) = std::nan("");
  EXPECT_TRUE(contains(error_of([&] { check_dissipative("otter", "D", matrix); }), "finite"));
  EXPECT_TRUE(contains(error_of([&] { check_symmetric("otter", "M", matrix); }), "= nan"));
}

}  // namespace
}  // namespace trident::sim
