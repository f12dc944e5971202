// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>

#include "filter/differences.h"
#include "fusion/robot_motion.h"
#include "team_run.h"
#include "trident_base/error.h"
#include "trident_base/random_stream.h"
#include "trident_estimation/fusion/team_fusion.h"

namespace trident::estimation {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// A team of two anywhere, moving and tilted.
VectorXd anywhere(const TeamModel& model, std::uint64_t seed) {
  RandomStream stream(seed, "fusion_test");
  VectorXd d(model.dim());
  for (Index i = 0; i < d.size(); ++i) d(i) = stream.normal(static_cast<std::uint64_t>(i), 0);
  for (Index robot = 0; robot < 2; ++robot) {
    d.segment<3>(TeamModel::kDofs * robot) *= 20.0;
    d.segment<2>(TeamModel::kDofs * robot + TeamModel::kRotation) *= 0.3;
  }
  VectorXd level = VectorXd::Zero(2 * TeamModel::kNumbers);
  level(3) = level(TeamModel::kNumbers + 3) = 1.0;
  return model.boxplus(level, d);
}

TeamModel two_robots() {
  RobotMotion first, second;
  first.speed = {4.0, 3.0, 1.0};
  second.leveling = 0.0;
  return TeamModel({first, second});
}

TEST(TeamModel, JacobianIsThatOfThePrediction) {
  const TeamModel model = two_robots();
  for (const double dt : {1e-4, 0.03, 0.4}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const VectorXd x = anywhere(model, seed);
      const MatrixXd numeric = model.Model::jacobian(x, {}, dt);
      EXPECT_LT((model.jacobian(x, {}, dt) - numeric).cwiseAbs().maxCoeff(), 1e-6) << dt;
    }
  }
}

TEST(TeamModel, WhatMovesOneStateToAnotherDoesSo) {
  const TeamModel model = two_robots();
  const VectorXd a = anywhere(model, 1), b = anywhere(model, 2);
  const VectorXd moved = model.boxplus(b, model.boxminus(a, b));
  EXPECT_LT(model.boxminus(moved, a).norm(), 1e-12);
}

// However the time is cut into steps, the noise of motion along a line is the same.
TEST(TeamModel, NoiseOfTwoStepsIsThatOfOne) {
  RobotMotion motion;
  motion.leveling = 0.0;
  RobotState robot;
  robot.T_world_base = SE3::from_xyz_rpy({1.0, 2.0, 3.0}, 0.1, -0.2, 0.7);
  const MotionMatrix F = motion_jacobian(motion, robot, 0.03);
  const MotionMatrix twice =
      F * motion_noise(motion, robot, 0.02) * F.transpose() + motion_noise(motion, robot, 0.03);
  EXPECT_LT((twice - motion_noise(motion, robot, 0.05)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(TeamModel, VelocitiesKeepTheirDeviation) {
  RobotMotion motion;
  motion.leveling = 0.0;
  const RobotState robot;
  const MotionMatrix Q = motion_noise(motion, robot, 200.0);
  EXPECT_NEAR(Q(6, 6), motion.speed.x() * motion.speed.x(), 1e-6);
  EXPECT_NEAR(Q(11, 11), motion.turn.z() * motion.turn.z(), 1e-6);
}

TEST(TeamModel, ATiltedRobotBecomesLevel) {
  RobotState robot;
  robot.T_world_base = SE3::from_xyz_rpy({}, 0.5, -0.3, 1.0);
  const Vector3d rpy = moved({}, robot, 20.0).T_world_base.rpy();
  EXPECT_NEAR(rpy.head<2>().norm(), 0.0, 1e-3);
}

TEST(TeamModel, AbsurdMotionsAreNamed) {
  EXPECT_THROW(TeamModel({}), Error);
  RobotMotion motion;
  motion.speed.y() = 0.0;
  EXPECT_THROW(TeamModel({motion}), Error);
  motion = {};
  motion.map_drift = NAN;
  EXPECT_THROW(TeamModel({motion}), Error);
}

TEST(TeamStart, KnowsTheRobotInItsMapBetterThanInTheWorld) {
  RobotStart start;
  start.p_world_map = {5.0, -3.0, 1.0};
  start.yaw_world_map = 0.7;
  start.T_map_base = SE3::from_xyz_rpy({30.0, 10.0, 2.0}, 0.1, 0.0, -2.0);
  start.map_yaw_sigma = 0.1;
  const TeamStart team = team_start({start});
  const Measurement pose =
      map_pose({SimTime{}, "slam"}, 0, start.T_map_base, MatrixXd::Identity(6, 6));
  const MatrixXd H = pose.H(team.state);
  MatrixXd P(10, 10);
  for (Index i = 0; i < 10; ++i) {
    for (Index j = 0; j < 10; ++j) P(i, j) = team.covariance(pose.dofs[i], pose.dofs[j]);
  }
  const MatrixXd in_map = H * P * H.transpose();
  EXPECT_LT((pose.h(team.state) - pose.z).norm(), 1e-12);
  EXPECT_NEAR(in_map(0, 0), start.base_sigma * start.base_sigma, 1e-9);
  EXPECT_NEAR(in_map(5, 5), start.base_turn_sigma * start.base_turn_sigma, 1e-9);
  EXPECT_NEAR(team.covariance(0, 0), 0.25 + 1.0 + std::pow(0.1 * (team.state(1) + 3.0), 2), 1e-9);
}

/// Each kind of measurement, by its name.
struct Named {
  const char* name;
  std::function<Measurement()> make;
};

Sighting seen_from_above() {
  Sighting sighting;
  sighting.observer = 1;
  sighting.target = 0;
  sighting.direction_base_target = {0.1, -0.2, -1.0};
  sighting.direction_variance = 1e-4;
  sighting.range = 20.0;
  sighting.range_variance = 0.1;
  sighting.p_base_sensor = {0.2, 0.0, -0.1};
  return sighting;
}

const Named kMeasurements[] = {
    {"map_pose",
     [] {
       return map_pose({{}, "s"}, 1, SE3::from_xyz_rpy({1.0, 2.0, 3.0}, 0.1, 0.2, 3.0),
                       MatrixXd::Identity(6, 6));
     }},
    {"planar",
     [] {
       return map_pose({{}, "s"}, 1, SE3::from_xyz_rpy({1.0, 2.0, 0.0}, 0.0, 0.0, 3.0),
                       MatrixXd::Identity(3, 3), PoseRows::kPlanar);
     }},
    {"world_pose",
     [] {
       return world_pose({{}, "s"}, 0, SE3{}, MatrixXd::Identity(6, 6), false);
     }},
    {"shared_pose",
     [] {
       return world_pose({{}, "s"}, 0, SE3{}, MatrixXd::Identity(6, 6), true);
     }},
    {"twist",
     [] {
       return twist({{}, "s"}, 0, Vector3d::UnitX(), Vector3d::UnitZ(), MatrixXd::Identity(6, 6));
     }},
    {"gnss",
     [] {
       return gnss({{}, "s"}, 1, {1.0, 2.0, 3.0}, {0.3, -0.2, 1.0}, MatrixXd::Identity(3, 3));
     }},
    {"compass",
     [] {
       return compass({{}, "s"}, 1, 3.0, 0.01);
     }},
    {"sighting",
     [] {
       return sighting({{}, "s"}, seen_from_above());
     }},
    {"bearing",
     [] {
       Sighting bearing = seen_from_above();
       bearing.range_variance = 0.0;
       return sighting({{}, "s"}, bearing);
     }},
    {"radio_range",
     [] {
       return radio_range({{}, "s"}, 0, 1, 10.0, 1.0);
     }},
    {"altitude", [] {
       return altitude({{}, "s"}, 1, 2.0, {0.5, 0.0, -0.3}, 0.1);
     }}};

class EveryMeasurement : public testing::TestWithParam<Named> {};
INSTANTIATE_TEST_SUITE_P(Team, EveryMeasurement, testing::ValuesIn(kMeasurements),
                         [](const auto& info) { return info.param.name; });

TEST_P(EveryMeasurement, HasTheJacobianOfItsFunction) {
  const TeamModel model = two_robots();
  const Measurement measurement = GetParam().make();
  int checked = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const VectorXd x = anywhere(model, seed);
    const VectorXd center = measurement.h(x);
    const Vector3d between =
        model.robot(x, 1).T_world_base.inverse() * model.robot(x, 0).T_world_base.p;
    const bool is_behind = between.dot(seen_from_above().direction_base_target) < 1.0;
    if (is_behind && measurement.z.size() <= 3) continue;  // folded, where nothing is used
    const MatrixXd numeric = central_differences(model.dim(), [&](const VectorXd& d) {
      const VectorXd h = measurement.h(model.boxplus(x, d));
      return measurement.residual ? measurement.residual(h, center) : VectorXd(h - center);
    });
    MatrixXd analytic = MatrixXd::Zero(center.size(), model.dim());
    const MatrixXd H = measurement.H(x);
    ASSERT_EQ(static_cast<std::size_t>(H.cols()), measurement.dofs.size());
    for (Index i = 0; i < H.cols(); ++i) {
      analytic.col(measurement.dofs[static_cast<std::size_t>(i)]) = H.col(i);
    }
    EXPECT_LT((analytic - numeric).cwiseAbs().maxCoeff(), 1e-6) << "seed " << seed;
    ++checked;
  }
  EXPECT_GE(checked, 3);
}

TEST(Sighting, OfWhatIsBehindIsFarOff) {
  Sighting ahead = seen_from_above();
  ahead.direction_base_target = Vector3d::UnitX();
  ahead.p_base_sensor.setZero();
  const Measurement measurement = sighting({{}, "s"}, ahead);
  VectorXd x = anywhere(two_robots(), 1);
  RobotState target;
  target.T_world_base = TeamModel::robot(x, 1).T_world_base * SE3{{}, {-20.0, 0.1, 0.0}};
  TeamModel::set_robot(target, 0, x);
  EXPECT_GT(measurement.h(x).head<2>().norm(), 1.9);
}

class TeamFilters : public testing::TestWithParam<FilterKind> {};
INSTANTIATE_TEST_SUITE_P(Filters, TeamFilters, testing::Values(FilterKind::kEkf, FilterKind::kUkf));

// As TheCovarianceIsThatOfTheErrors of filter_test.cpp; `./trident bench fusion` has 50 seeds.
TEST_P(TeamFilters, AreConsistent) {
  constexpr int kSeeds = 10;
  double sum = 0.0, nis = 0.0, size = 0.0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    SceneOptions options;
    options.seed = seed;
    options.duration = 8.0;
    const TeamRun result = run(make_scene(options), {GetParam(), 0.0, false, {}});
    sum += result.nees.back();
    for (const auto& [normalized, numbers] : result.nis) {
      nis += normalized;
      size += numbers;
    }
  }
  EXPECT_NEAR(sum / kSeeds, 48.0, 2.6 * std::sqrt(2.0 * 48.0 / kSeeds));
  EXPECT_NEAR(nis / size, 1.0, 2.6 * std::sqrt(2.0 / size));
}

TEST_P(TeamFilters, DoNotCareForTheOrderOfArrival) {
  SceneOptions options;
  options.duration = 4.0;
  const TeamScene scene = make_scene(options);
  const SimTime keep = SimTime::from_seconds(1.0);
  History sorted(first_belief(scene, GetParam()), keep, TrustParams{}), late = sorted;
  RandomStream delay(3, "fusion_test");
  std::vector<std::pair<double, std::size_t>> arrivals;
  for (std::size_t i = 0; i < scene.measurements.size(); ++i) {
    arrivals.emplace_back(scene.measurements[i].stamp.seconds() + delay.uniform(i, 0), i);
    sorted.add(scene.measurements[i]);
  }
  std::sort(arrivals.begin(), arrivals.end());
  for (std::size_t i = 0; i < arrivals.size();) {
    std::vector<Measurement> batch;
    for (; i < arrivals.size() && batch.size() < 20; ++i) {
      batch.push_back(scene.measurements[arrivals[i].second]);
    }
    late.add_all(std::move(batch));
  }
  EXPECT_EQ(late.newest().state(), sorted.newest().state());
  EXPECT_EQ(late.newest().covariance(), sorted.newest().covariance());
}

// A UGV that the UAV sees is found although its own map drifts and it has no GNSS.
TEST(TeamFilter, AUavThatSeesAUgvKeepsItInPlace) {
  SceneOptions options;
  options.seed = 2;
  options.duration = 30.0;
  options.gnss_gone_from = 0.0;
  options.is_ugv_followed = true;
  const TeamScene scene = make_scene(options);
  const auto blind = [](const std::string& source) { return source != "uav/sees/ugv"; };
  const TeamRun seen = run(scene, {FilterKind::kEkf, 10.0, true, {}});
  const TeamRun unseen = run(scene, {FilterKind::kEkf, 10.0, true, blind});
  EXPECT_LT(std::sqrt(seen.square_error[kUgv]), 0.5);
  EXPECT_GT(unseen.square_error[kUgv], 2.0 * seen.square_error[kUgv]);
}

/// Two robots whose maps lie 10 m apart.
TeamFusion team_of_two() {
  RobotStart first, second;
  second.p_world_map = {10.0, 0.0, 0.0};
  return TeamFusion({first, second}, {});
}

void hear(TeamFusion& team, std::size_t robot, double seconds, const SE3& T_map_base) {
  const SimTime stamp = SimTime::from_seconds(seconds);
  team.note_pose(robot, stamp, T_map_base);
  team.add(map_pose({stamp, robot == 0 ? "first" : "second"}, robot, T_map_base,
                    1e-4 * MatrixXd::Identity(6, 6)));
}

TEST(TeamFusion, BeginsWhereAllRobotsAreInTheirMaps) {
  TeamFusion team = team_of_two();
  hear(team, 0, 1.0, SE3::from_xyz_rpy({200.0, 0.0, 0.0}, 0.0, 0.0, 3.0));
  EXPECT_FALSE(team.has_started());
  hear(team, 1, 1.1, SE3::from_xyz_rpy({0.0, 50.0, 0.0}, 0.0, 0.0, 0.0));
  ASSERT_TRUE(team.has_started());
  ASSERT_EQ(team.update().size(), 1U);
  const auto belief = team.at(SimTime::from_seconds(1.2));
  ASSERT_TRUE(belief.has_value());
  const RobotState first = TeamModel::robot(belief->state(), 0);
  EXPECT_NEAR(first.T_world_base.p.x(), 200.0, 0.1);
  EXPECT_NEAR(first.T_world_base.rpy().z(), 3.0, 0.01);
  EXPECT_NEAR(TeamModel::robot(belief->state(), 1).T_world_base.p.x(), 10.0, 0.1);
  EXPECT_FALSE(team.at(SimTime::from_seconds(1.0)).has_value());
}

TEST(TeamFusion, DoesNotWaitForeverForARobotThatIsSilent) {
  TeamFusion team = team_of_two();
  hear(team, 0, 1.0, SE3{});
  hear(team, 0, 2.9, SE3{});
  EXPECT_FALSE(team.has_started());
  hear(team, 0, 3.0, SE3{});
  EXPECT_TRUE(team.has_started());
  team.restart();
  EXPECT_FALSE(team.has_started());
  EXPECT_TRUE(team.update().empty());
}

TEST(TeamFusion, OptionsOutOfRangeAreNamed) {
  TeamFusionOptions options;
  options.gate = 1.0;
  EXPECT_THROW(TeamFusion({RobotStart{}}, options), Error);
  options = {};
  options.keep = SimTime{-1};
  EXPECT_THROW(TeamFusion({RobotStart{}}, options), Error);
}

}  // namespace
}  // namespace trident::estimation
