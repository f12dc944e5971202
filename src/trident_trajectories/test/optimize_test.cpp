// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_trajectories/optimize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "team_problems.h"
#include "trident_trajectories/certificate.h"

namespace trident::trajectories {
namespace {

/// Least distance of any two over 1 kHz.
double least_distance(const std::vector<Trajectory>& paths) {
  double least = std::numeric_limits<double>::infinity();
  const int samples = static_cast<int>(1000.0 * paths.front().duration());
  for (int k = 0; k <= samples; ++k)
    for (std::size_t i = 0; i < paths.size(); ++i)
      for (std::size_t j = i + 1; j < paths.size(); ++j)
        least = std::min(least, (paths[i].at(0.001 * k).p - paths[j].at(0.001 * k).p).norm());
  return least;
}

double greatest_speed(const Trajectory& path) {
  double greatest = 0.0;
  for (double t = 0.0; t <= path.duration(); t += 0.001)
    greatest = std::max(greatest, path.at(t).v.norm());
  return greatest;
}

class EachMethod : public testing::TestWithParam<std::string> {};

TEST_P(EachMethod, SwapsSixAndKeepsThemApartAtAllTimes) {
  OptimizeOptions options;
  options.method = GetParam();
  options.starts = {Start::kSwirlLayers};
  const Problem problem = antipodal_swap(6);
  const Solution solution = optimize(problem, options);
  ASSERT_TRUE(solution.is_feasible) << solution.message;
  EXPECT_GE(least_distance(solution.trajectories), 1.5 * (1.0 - 1e-4));
  EXPECT_LE(greatest_speed(solution.trajectories[2]), 6.0 * (1.0 + 1e-4));
  EXPECT_LT(solution.jerk, 165.0);
}
INSTANTIATE_TEST_SUITE_P(Trajectories, EachMethod, testing::ValuesIn(method_names()));

TEST(Optimize, GivesTheSameBitsWithTwoThreads) {
  OptimizeOptions two;
  two.threads = 2;
  const Solution a = optimize(antipodal_swap(4)), b = optimize(antipodal_swap(4), two);
  for (std::size_t i = 0; i < a.trajectories.size(); ++i) {
    const ControlPoints& p = a.trajectories[i].control_points();
    const ControlPoints& q = b.trajectories[i].control_points();
    EXPECT_EQ(std::memcmp(p.data(), q.data(), sizeof(double) * p.size()), 0);
  }
}

TEST(Optimize, LetsThreeKindsGatherWhereItSuitsThem) {
  const Problem problem = three_platforms();
  const Solution solution = optimize(problem);
  ASSERT_TRUE(solution.is_feasible) << solution.message;
  const double T = solution.trajectories[0].duration();
  const Eigen::Vector3d uav = solution.trajectories[0].at(T).p;
  const Eigen::Vector3d usv = solution.trajectories[2].at(T).p;
  EXPECT_NEAR((uav - usv - Eigen::Vector3d(-1.5, 0.0, 5.0)).norm(), 0.0, 1e-9);
  EXPECT_TRUE(violations(problem, solution.trajectories, -1e-4).empty());
}

TEST(Optimize, LandsOnADeckWithItsVelocity) {
  Problem problem = antipodal_swap(1);
  Robot& robot = problem.robots[0];
  robot.goal.state.p = {0.0, 0.0, 0.5};
  robot.goal.deck = std::make_shared<Prediction>(std::vector<Prediction::Knot>{
      {0.0, {0.0, 0.0, 1.0}, {1.0, 0.2, 0.3}}, {10.0, {9.0, 3.0, 1.1}, {0.8, 0.0, -0.3}}});
  problem.durations[0] = {5.0, 2.0, 12.0, true};
  problem.cost = cost_of_name("mixed");
  const Solution solution = optimize(problem);
  ASSERT_TRUE(solution.is_feasible) << solution.message;
  const double T = solution.trajectories[0].duration();
  const MotionState deck = robot.goal.deck->at(T), end = solution.trajectories[0].at(T);
  EXPECT_NEAR((end.p - deck.p).norm(), 0.5, 1e-9);
  EXPECT_NEAR((end.v - deck.v).norm(), 0.0, 1e-9);
}

TEST(Optimize, ArrivesInOrderWithFreeTimes) {
  Problem problem = antipodal_swap(2);
  problem.durations = {{6.0, 4.0, 20.0, true}, {6.0, 4.0, 20.0, true}};
  problem.robots[1].duration = 1;
  problem.order = {{0, 1, 1.0}};
  problem.cost = cost_of_name("time");
  const Solution solution = optimize(problem);
  ASSERT_TRUE(solution.is_feasible) << solution.message;
  EXPECT_GE(solution.trajectories[1].duration(), solution.trajectories[0].duration() + 1.0 - 1e-3);
  EXPECT_LT(solution.trajectories[0].duration(), 6.0) << "time was to be saved";
}

TEST(Optimize, PassesObstaclesThatStandAndMove) {
  Problem problem = antipodal_swap(1);
  problem.obstacles =
      std::make_shared<RoundObstacles>(std::vector<RoundObstacle>{{{3.0, 0.2, 0.0}, 1.0, true}});
  problem.moving.push_back(
      {"person", Prediction::constant_velocity({-4.0, -4.0, 0.0}, {0.0, 1.0, 0.0}), 0.5});
  const Solution solution = optimize(problem);
  ASSERT_TRUE(solution.is_feasible) << solution.message;
  for (double t = 0.0; t <= 6.0; t += 0.001) {
    const Eigen::Vector3d p = solution.trajectories[0].at(t).p;
    EXPECT_GE(std::hypot(p.x() - 3.0, p.y() - 0.2), 1.75 * (1.0 - 1e-4));
    EXPECT_GE(std::hypot(p.x() + 4.0, p.y() + 4.0 - t), 1.25 * (1.0 - 1e-4));
  }
}

TEST(Infeasible, SaysWhoWhenWhichLimitAndWhatWouldBeEnough) {
  Problem problem = antipodal_swap(2);
  problem.robots[1].limits.max_velocity = 2.5;  // 16 m in 6 s take 2.67 m/s at least
  const Solution solution = optimize(problem);
  ASSERT_FALSE(solution.is_feasible);
  ASSERT_FALSE(solution.violations.empty());
  EXPECT_EQ(solution.violations.front().limit, LimitKind::kVelocity);
  EXPECT_EQ(solution.violations.front().robots, std::vector<std::size_t>{1});
  EXPECT_NE(solution.message.find("'uav1' at "), std::string::npos) << solution.message;
  EXPECT_NE(solution.message.find("feasible with max_velocity "), std::string::npos)
      << solution.message;
  problem.robots[1].limits.max_velocity =
      std::stod(solution.message.substr(solution.message.find("with max_velocity ") + 18)) + 0.01;
  EXPECT_GT(problem.robots[1].limits.max_velocity, 16.0 / 6.0);
  EXPECT_TRUE(optimize(problem).is_feasible);
}

TEST(Infeasible, GoalsThatAreTooNearAreNamedAsASeparation) {
  Problem problem = antipodal_swap(3);
  problem.robots[2].goal.state.p = problem.robots[0].goal.state.p + Eigen::Vector3d(0.9, 0, 0);
  OptimizeOptions options;
  options.explain = false;
  const Solution solution = optimize(problem, options);
  ASSERT_FALSE(solution.is_feasible);
  EXPECT_EQ(solution.violations.front().limit, LimitKind::kSeparation);
  EXPECT_EQ(solution.violations.front().robots, (std::vector<std::size_t>{0, 2}));
  EXPECT_NEAR(solution.violations.front().value, 0.9, 1e-3);
}

}  // namespace
}  // namespace trident::trajectories
