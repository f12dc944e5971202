// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "marine/vessel/vessel_dynamics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "marine/environment/wave_field.h"
#include "marine/vessel/thruster.h"
#include "marine_random.h"
#include "standalone_vessel.h"
#include "test_world.h"
#include "trident_base/angle.h"

namespace trident::sim {
namespace {

Vector6d surge(double force) {
  Vector6d tau = Vector6d::Zero();
  tau[0] = force;
  return tau;
}

/// The Otter without what makes it lossy.
VesselParams ideal_otter() {
  VesselParams params = shipped_vessel("otter");
  params.munk = true;
  params.linear_damping.setZero();
  params.quadratic_damping.setZero();
  params.cross_flow.length_m = 0.0;
  return params;
}

TEST(VesselDynamics, AccelerationSolvesFossensEquation) {
  const VesselDynamics otter(shipped_vessel("otter"));
  const Vector6d nu = random_vector6(1), tau = 100.0 * random_vector6(2);
  HullWater water;
  const Vector6d nu_dot = otter.nu_dot(nu, water, tau);
  const Vector6d left = (otter.rigid_body_mass() + otter.added_mass()) * nu_dot +
                        rigid_body_coriolis(otter.rigid_body(), nu) * nu +
                        (otter.added_mass_coriolis(nu) + otter.damping(nu)) * nu;
  EXPECT_LT((left - tau).norm(), 1e-9 * tau.norm());
}

/// In a current the equation holds in nu_r alone, for a current that is constant in the world.
TEST(VesselDynamics, UniformCurrentEntersByTheRelativeVelocity) {
  const VesselDynamics otter(shipped_vessel("otter"));
  const Vector6d nu = random_vector6(3), tau = 100.0 * random_vector6(4);
  HullWater water;
  water.velocity.head<3>() = Eigen::Vector3d(0.7, -0.4, 0.1);
  const Vector6d nu_r = nu - water.velocity;
  const Eigen::Vector3d w = nu.tail<3>();
  Vector6d nu_c_dot = Vector6d::Zero();
  nu_c_dot.head<3>() = -w.cross(water.velocity.head<3>());
  const Vector6d nu_r_dot = otter.nu_dot(nu, water, tau) - nu_c_dot;
  EXPECT_LT((nu_r_dot - otter.nu_dot(nu_r, HullWater{}, tau)).norm(), 1e-9);
}

TEST(VesselDynamics, EngineReachesTheSolvedAcceleration) {
  StandaloneVessel otter(shipped_vessel("otter"), Restoring::kNone);
  const Vector6d nu = random_vector6(5), tau = 50.0 * random_vector6(6);
  otter.set_nu(nu);
  const Vector6d expected = otter.dynamics().nu_dot(nu, HullWater{}, tau);
  constexpr double kStep = 1e-6;
  otter.step(tau, kStep);
  EXPECT_LT(((otter.nu() - nu) / kStep - expected).norm(), 1e-3 * expected.norm());
}

/// Without water there is nothing to hand over, whatever the engine does already.
TEST(VesselDynamics, NothingIsHandedOverWithoutWater) {
  VesselParams params = ideal_otter();
  params.added_mass.setZero();
  const VesselDynamics otter(params);
  const Vector6d tau = 50.0 * random_vector6(8);
  EXPECT_LT(otter.engine_wrench(random_vector6(7), HullWater{}, tau, tau, 0.01).norm(), 1e-9);
}

TEST(VesselDynamics, TerminalSpeedIsWhereDragEqualsThrust) {
  VesselParams params = shipped_vessel("otter");
  params.quadratic_damping[0] = 20.0;
  StandaloneVessel otter(params, Restoring::kLinear);
  otter.set_springs(Vector6d(Vector6d::Constant(1e4)).asDiagonal());
  for (int i = 0; i < 3000; ++i) otter.step(surge(120.0), 0.01);
  const double c = params.linear_damping[0];
  const double expected = (-c + std::sqrt(c * c + 4.0 * 20.0 * 120.0)) / (2.0 * 20.0);
  EXPECT_NEAR(otter.nu()[0], expected, 1e-6);
}

TEST(VesselDynamics, EnergyOfAnIdealFluidIsKept) {
  StandaloneVessel otter(ideal_otter(), Restoring::kNone);
  Vector6d nu;
  nu << 1.5, 0.4, -0.2, 0.3, -0.2, 0.5;
  otter.set_nu(nu);
  const double before = otter.kinetic_energy();
  for (int i = 0; i < 10000; ++i) otter.step(Vector6d::Zero(), 1e-4);
  EXPECT_NEAR(otter.kinetic_energy() / before, 1.0, 1e-3);
}

class EveryVessel : public testing::TestWithParam<const char*> {};

TEST_P(EveryVessel, EnergyNeverGrowsWithoutThrust) {
  StandaloneVessel boat(shipped_vessel(GetParam()), Restoring::kNone);
  for (int k = 0; k < 20; ++k) {
    boat.set_nu(2.0 * random_vector6(static_cast<std::uint64_t>(k)));
    double energy = boat.kinetic_energy();
    for (int i = 0; i < 500; ++i) {
      boat.step(Vector6d::Zero(), 0.01);
      ASSERT_LE(boat.kinetic_energy(), energy * (1.0 + 1e-9)) << "start " << k << " step " << i;
      energy = boat.kinetic_energy();
    }
  }
}

TEST_P(EveryVessel, CurrentCarriesTheSameePathAlong) {
  const VesselParams params = shipped_vessel(GetParam());
  StandaloneVessel still(params), carried(params);
  CurrentParams flow;
  flow.kind = CurrentKind::kUniform;
  flow.speed = 0.8;
  flow.direction = 0.7;
  const Eigen::Vector3d v(0.8 * std::cos(0.7), 0.8 * std::sin(0.7), 0.0);
  Vector6d nu = Vector6d::Zero();
  still.set_nu(nu);
  nu.head<3>() = v;
  carried.set_nu(nu);
  const double thrust = 0.3 * params.mass;
  double farthest = 0.0;
  for (int i = 0; i < 12000; ++i) {
    farthest = std::max(farthest, still.T_world_co().p.head<2>().norm());
    Vector6d tau = surge(thrust);
    tau[5] = 0.3 * thrust * std::sin(0.002 * i);
    still.step(tau, 0.01);
    carried.step(tau, 0.01, StillWater(), Current(flow));
  }
  EXPECT_GT(farthest, 5.0);
  EXPECT_TRUE(is_near(carried.T_world_co().p, still.T_world_co().p + 120.0 * v, 1e-3));
}

/// Every half second each thruster jumps to another thrust within its limits.
TEST_P(EveryVessel, MillionRandomThrusterStepsStayBounded) {
  const VesselParams params = shipped_vessel(GetParam());
  StandaloneVessel boat(params);
  std::vector<Thruster> thrusters(params.thrusters.begin(), params.thrusters.end());
  const RandomStream stream(5, "random thrust");
  double fastest = 0.0, deepest = 0.0, steepest = 0.0;
  for (std::uint64_t i = 0; i < 1000000; ++i) {
    Vector6d tau = Vector6d::Zero();
    for (std::size_t k = 0; k < thrusters.size(); ++k) {
      const ThrusterParams& p = thrusters[k].params();
      if (i % 50 == 0) {
        const double part = stream.uniform(i, static_cast<std::uint32_t>(k));
        thrusters[k].command(p.min_command + part * (p.max_command - p.min_command));
      }
      thrusters[k].step(0.01);
      tau += thrusters[k].wrench();
    }
    boat.step(tau, 0.01);
    fastest = std::max(fastest, boat.nu().head<3>().norm());
    deepest = std::max(deepest, std::abs(boat.T_world_co().p.z()));
    steepest = std::max(steepest, std::acos((boat.T_world_co().R * Eigen::Vector3d::UnitZ()).z()));
  }
  EXPECT_LT(fastest, 6.0);
  EXPECT_LT(deepest, 0.3);
  EXPECT_LT(steepest, 0.6);
  EXPECT_GT(fastest, 0.3);
}

/// Beam sea of half a metre; the boat goes up and down with the water and stays on it.
TEST_P(EveryVessel, RidesASea) {
  const VesselParams params = shipped_vessel(GetParam());
  StandaloneVessel boat(params);
  boat.set_at_rest();
  WaveParams waves;
  waves.spectrum = WaveSpectrum::kJonswap;
  waves.significant_height = 0.5;
  waves.peak_period = 4.0;
  waves.direction = kPi / 2;
  waves.spreading = 10.0;
  waves.ramp_time = 5.0;
  const WaveField sea(waves, 11);
  const Current current{CurrentParams{}};
  double height = 0.0, apart = 0.0, tilt = 0.0;
  constexpr int kSteps = 12000;
  for (int i = 0; i < kSteps; ++i) {
    boat.step(Vector6d::Zero(), 0.01, sea, current);
    const SE3 T = boat.T_world_co();
    const double eta = sea.elevation_m(T.p.head<2>(), boat.time_s());
    height += T.p.z() * T.p.z() / kSteps;
    apart += (T.p.z() - eta) * (T.p.z() - eta) / kSteps;
    tilt = std::max(tilt, std::acos((T.R * Eigen::Vector3d::UnitZ()).z()));
  }
  EXPECT_NEAR(4.0 * std::sqrt(height), 0.5, 0.15);
  EXPECT_LT(std::sqrt(apart), 0.06);
  EXPECT_LT(tilt, 0.7);
  EXPECT_GT(tilt, 0.03);
}

INSTANTIATE_TEST_SUITE_P(All, EveryVessel,
                         testing::Values("otter", "wamv", "heron", "small_catamaran"));

/// A step ten times as long as the fastest damping allows an explicit method.
TEST(VesselDynamics, StiffDampingIsStable) {
  VesselParams params = shipped_vessel("small_catamaran");
  params.linear_damping *= 1000.0;
  StandaloneVessel boat(params, Restoring::kNone);
  boat.set_nu(random_vector6(9));
  double energy = boat.kinetic_energy();
  for (int i = 0; i < 100; ++i) {
    boat.step(Vector6d::Zero(), 0.01);
    ASSERT_LE(boat.kinetic_energy(), energy);
    energy = boat.kinetic_energy();
  }
}

TEST(VesselDynamics, MunkMomentTurnsTheBoatAcrossOnlyWhenItIsKept) {
  VesselParams params = ideal_otter();
  params.center_of_gravity.setZero();
  Vector6d nu = Vector6d::Zero();
  nu[0] = 2.0;
  nu[1] = 0.3;
  for (const bool munk : {true, false}) {
    params.munk = munk;
    const VesselDynamics otter(params);
    const Vector6d nu_dot = otter.nu_dot(nu, HullWater{}, Vector6d::Zero());
    const double expected = munk ? -(82.5 - 5.5) * 2.0 * 0.3 : 0.0;
    EXPECT_NEAR(((otter.rigid_body_mass() + otter.added_mass()) * nu_dot)[5], expected, 1e-9);
  }
}

TEST(VesselDynamics, CrossFlowDragIsTheStripIntegral) {
  VesselParams params = ideal_otter();
  params.cross_flow = {2.0, 0.2, 1.0};
  const VesselDynamics otter(params);
  Vector6d nu = Vector6d::Zero();
  nu[1] = 0.5;
  EXPECT_NEAR((otter.damping(nu) * nu)[1], 0.5 * 1025.0 * 0.2 * 2.0 * 0.25, 1e-9);
  nu << 0, 0, 0, 0, 0, 0.8;  // integral of |x r| x r x dx = r^2 L^4 / 32
  EXPECT_NEAR((otter.damping(nu) * nu)[5] / (0.5 * 1025.0 * 0.2 * 0.64 * 16.0 / 32.0), 1.0, 0.01);
}

/// About CO at rest, from hydrostatics alone.
Matrix6d stiffness(const VesselParams& params) {
  const Hydrostatics h = Hull(params.hull, params.water_density, 9.81).hydrostatics();
  const double heave = params.water_density * 9.81 * h.waterplane_m2, x = h.center_of_flotation_x_m;
  const double z_cg = params.center_of_gravity.z();
  Matrix6d G = Matrix6d::Zero();
  G(2, 2) = heave;
  G(2, 4) = G(4, 2) = -heave * x;
  G(3, 3) = params.mass * 9.81 * h.gm_transverse_m(z_cg);
  G(4, 4) = params.mass * 9.81 * h.gm_longitudinal_m(z_cg) + heave * x * x;
  return G;
}

/// The Otter let go, heeled, trimmed and lifted: all six coupled, as exp(A t) of the linear system.
TEST(Otter, FreeDecayIsThatOfTheLinearSystem) {
  VesselParams params = shipped_vessel("otter");
  StandaloneVessel otter(params);
  const Matrix6d M = otter.dynamics().rigid_body_mass() + otter.dynamics().added_mass();
  Eigen::Matrix<double, 12, 12> A = Eigen::Matrix<double, 12, 12>::Zero();
  A.topRightCorner<6, 6>().setIdentity();
  A.bottomLeftCorner<6, 6>() = -M.inverse() * stiffness(params);
  A.bottomRightCorner<6, 6>() = -M.inverse() * params.linear_damping_flu();
  Eigen::Matrix<double, 12, 1> x = Eigen::Matrix<double, 12, 1>::Zero();
  x.segment<3>(2) << 0.002, 0.01, 0.004;
  otter.set_pose(SE3::from_xyz_rpy({0, 0, x[2]}, x[3], x[4], 0));
  constexpr double kStep = 1e-3;
  const Eigen::Matrix<double, 12, 12> step = (kStep * A).exp();
  for (int i = 0; i < 3000; ++i) {
    otter.step(Vector6d::Zero(), kStep);
    x = step * x;
    const SE3 T = otter.T_world_co();
    ASSERT_NEAR(T.p.z(), x[2], 1e-4) << i;
    ASSERT_NEAR(T.rpy().x(), x[3], 3e-4) << i;
    ASSERT_NEAR(T.rpy().y(), x[4], 1.5e-4) << i;
  }
}

TEST(Wind, PushesByTheApparentWind) {
  const Vector6d wrench = wind_wrench({0.5, 0.6, 0.33}, {-4.0, 3.0, 1.0});
  Vector6d expected;
  expected << -8.0, 5.4, 0, 0, 0, 2 * 0.33 * 12.0;
  EXPECT_LT((wrench - expected).norm(), 1e-12);
}

TEST(LegacyVrx, ForceIsThatOfTheEquation) {
  const VesselParams params = shipped_vessel("wamv");
  LegacyVrxForce force(params);
  Vector6d nu = Vector6d::Zero();
  nu << 2.0, -1.0, 0.5, 0.1, 0.2, -0.3;
  Vector6d expected;
  expected << -(51.3 + 72.4 * 2.0) * 2.0, 40.0, -500.0 * 0.5 - 0.1 * 0.5 / 0.01,
      -50.0 * 0.1 - 0.1 * 0.1 / 0.01, -50.0 * 0.2 - 0.1 * 0.2 / 0.01, 400.0 * 0.3;
  EXPECT_LT((force.wrench(nu, 0.01) - expected).norm(), 1e-9);
  expected[2] = -250.0;  // no acceleration any more
  EXPECT_NEAR(force.wrench(nu, 0.01)[2], expected[2], 1e-9);
}

}  // namespace
}  // namespace trident::sim
