// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "team_scenes.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "trident_base/angle.h"
#include "trident_base/random_stream.h"

namespace trident::benchmarks {
namespace {

using namespace trajectories;  // NOLINT: the names of one library

/// Uniform numbers, one after another.
class Draw {
 public:
  Draw(std::uint64_t seed, const char* what) : random_(seed, what) {}
  double between(double low, double high) {
    return low + (high - low) * random_.uniform(next_++, 0);
  }
  int up_to(int count) { return static_cast<int>(between(0.0, count)); }

 private:
  RandomStream random_;
  std::uint64_t next_ = 0;
};

constexpr int kTries = 4000;     // for a place that is clear
constexpr double kClear = 1.3;   // between starts and between goals, over what must be kept
constexpr double kPeak = 1.875;  // greatest over mean speed of the path of least jerk

Robot uav(const std::string& name) {
  Robot robot;
  robot.name = name;
  robot.limits.max_velocity = 5.0;
  robot.limits.max_acceleration = 5.0;
  robot.limits.collision_radius = 0.5;
  return robot;
}

Robot ground_robot(const std::string& name) {
  Robot robot;
  robot.name = name;
  robot.kind = Kind::kUnicycle;
  robot.limits.max_velocity = 2.0;
  robot.limits.max_acceleration = 1.5;
  robot.limits.max_turn_rate = 1.5;
  robot.limits.collision_radius = 0.5;
  return robot;
}

Robot vessel(const std::string& name) {
  Robot robot;
  robot.name = name;
  robot.kind = Kind::kVessel;
  robot.limits.max_velocity = 3.0;
  robot.limits.max_acceleration = 1.0;
  robot.limits.max_turn_rate = 0.8;
  robot.limits.collision_radius = 2.0;
  robot.limits.max_thrust = 800.0;
  robot.surge = {250.0, 50.0, 60.0, {0.1, 0.0}};
  return robot;
}

Robot robot_of(int kind, const std::string& name) {
  if (kind == 0) return ground_robot(name);
  return kind == 1 ? vessel(name) : uav(name);
}

bool is_clear(const Eigen::Vector3d& p, double radius, const std::vector<Robot>& others,
              bool is_goal, const std::vector<RoundObstacle>& obstacles) {
  for (const Robot& other : others) {
    const Eigen::Vector3d q = is_goal ? other.goal.state.p : other.start.p;
    if ((p - q).norm() < kClear * (radius + other.limits.collision_radius)) return false;
  }
  return std::all_of(obstacles.begin(), obstacles.end(), [&](const RoundObstacle& round) {
    return (p - round.center).head<2>().norm() > kClear * (radius + round.radius);
  });
}

/// A place in the arena that is clear of those of the others.
Eigen::Vector3d clear_place(Draw& draw, const Robot& robot, double half, bool is_goal,
                            const std::vector<Robot>& others,
                            const std::vector<RoundObstacle>& obstacles) {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  for (int i = 0; i < kTries; ++i) {
    p = {draw.between(-half, half), draw.between(-half, half), 0.0};
    if (robot.kind == Kind::kUav) p.z() = draw.between(3.0, 7.0);
    if (is_clear(p, robot.limits.collision_radius, others, is_goal, obstacles)) break;
  }
  return p;
}

void fill(Problem& problem, Draw& draw, int robots, double half,
          const std::vector<RoundObstacle>& obstacles) {
  double duration = 4.0;
  for (int i = 0; i < robots; ++i) {
    Robot robot = robot_of(draw.up_to(4), "r" + std::to_string(i));
    robot.start.p = clear_place(draw, robot, half, false, problem.robots, obstacles);
    robot.goal.state.p = clear_place(draw, robot, half, true, problem.robots, obstacles);
    const double delta = (robot.goal.state.p - robot.start.p).norm();
    duration = std::max(duration, 1.5 * kPeak * delta / robot.limits.max_velocity);
    problem.robots.push_back(robot);
  }
  problem.durations[0].value = duration;
  problem.min_height = 1.5;
}

}  // namespace

Problem antipodal_swap(int robots) {
  Problem problem;
  problem.durations[0].value = 6.0;
  for (int i = 0; i < robots; ++i) {
    const double angle = 2.0 * kPi * i / robots;
    const Eigen::Vector3d place(8.0 * std::cos(angle), 8.0 * std::sin(angle), 0.0);
    Robot robot = uav("uav" + std::to_string(i));
    robot.start.p = place + Eigen::Vector3d(0.0, 0.0, 10.0);
    robot.goal.state.p = -place + Eigen::Vector3d(0.0, 0.0, 10.0);
    robot.limits.max_velocity = 6.0;
    robot.limits.collision_radius = 0.75;
    problem.robots.push_back(robot);
  }
  return problem;
}

Problem three_platform_rendezvous() {
  Problem problem;
  problem.durations[0] = {12.0, 4.0, 40.0, true};
  problem.cost = cost_of_name("mixed");
  problem.places = {{0.0, 0.0, 0.0}};
  Robot flying = uav("uav"), driving = ground_robot("ugv"), swimming = vessel("usv");
  flying.start.p = {20.0, 25.0, 12.0};
  flying.goal.state.p = {0.0, 0.0, 4.0};
  driving.start.p = {-10.0, 3.0, 0.0};
  driving.goal.state.p = {-2.0, 0.0, 0.0};
  swimming.start.p = {14.0, -6.0, 0.0};
  swimming.goal.state.p = {2.0, 0.0, 0.0};
  for (Robot* robot : {&flying, &driving, &swimming}) {
    robot->goal.place = 0;
    problem.robots.push_back(*robot);
  }
  return problem;
}

Problem moving_boat_landing() {
  constexpr double kSpeed = 1.5, kSwell = 0.3, kFrequency = 0.9, kStep = 0.25;
  std::vector<Prediction::Knot> knots;
  for (int i = 0; i <= 100; ++i) {
    const double t = kStep * i;
    knots.push_back({t,
                     {kSpeed * t, 0.0, 1.0 + kSwell * std::sin(kFrequency * t)},
                     {kSpeed, 0.0, kSwell * kFrequency * std::cos(kFrequency * t)}});
  }
  Problem problem;
  problem.durations[0] = {8.0, 3.0, 20.0, true};
  problem.cost = cost_of_name("mixed");
  Robot robot = uav("uav");
  robot.start.p = {-12.0, 6.0, 8.0};
  robot.goal.state.p = {0.0, 0.0, 0.3};
  robot.goal.deck = std::make_shared<Prediction>(knots);
  problem.robots.push_back(robot);
  return problem;
}

Problem field_crossing() {
  Draw draw(5, "field");
  std::vector<RoundObstacle> obstacles;
  for (int i = 0; i < 50; ++i)
    obstacles.push_back(
        {{draw.between(-6.5, 6.5), draw.between(-14.0, 14.0), 0.0}, draw.between(0.2, 0.5), true});
  GridDistanceMap::Grid grid;
  grid.origin = {-20.0, -20.0, 0.0};
  grid.spacing = 0.2;
  grid.nodes = {201, 201, 1};
  Problem problem;
  problem.obstacles =
      std::make_shared<GridDistanceMap>(GridDistanceMap::sampled(grid, RoundObstacles(obstacles)));
  problem.durations[0].value = 18.0;
  for (int i = 0; i < 8; ++i) {
    Robot robot = ground_robot("ugv" + std::to_string(i));
    const double side = i % 2 == 0 ? 1.0 : -1.0, y = 3.0 * i - 10.5;
    robot.start.p = {-9.0 * side, y, 0.0};
    robot.goal.state.p = {9.0 * side, y, 0.0};
    robot.limits.collision_radius = 0.3;
    problem.robots.push_back(robot);
  }
  return problem;
}

Problem random_team(std::uint64_t seed) {
  Draw draw(seed, "team");
  const int robots = 2 + draw.up_to(19);
  const double half = 6.0 * std::sqrt(static_cast<double>(robots));
  std::vector<RoundObstacle> obstacles;
  for (int i = draw.up_to(11); i > 0; --i)
    obstacles.push_back({{draw.between(-half, half), draw.between(-half, half), 0.0},
                         draw.between(0.5, 1.5),
                         true});
  Problem problem;
  fill(problem, draw, robots, half, obstacles);
  if (!obstacles.empty()) problem.obstacles = std::make_shared<RoundObstacles>(obstacles);
  return problem;
}

InfeasibleTeam infeasible_team(std::uint64_t seed) {
  Draw draw(seed, "infeasible");
  InfeasibleTeam out{{}, LimitKind::kVelocity, 0};
  fill(out.problem, draw, 2 + draw.up_to(3), 15.0, {});
  out.robot = static_cast<std::size_t>(draw.up_to(static_cast<int>(out.problem.robots.size())));
  Robot& robot = out.problem.robots[out.robot];
  const double delta = (robot.goal.state.p - robot.start.p).norm();
  const double T = out.problem.durations[0].value, share = draw.between(0.5, 0.9);
  switch (draw.up_to(5)) {
    case 0:
      robot.limits.max_velocity = share * delta / T;
      break;
    case 1:  // from rest to rest: full ahead for one half, full astern for the other
      out.limit = LimitKind::kAcceleration;
      robot.limits.max_acceleration = share * 4.0 * delta / (T * T);
      break;
    case 2:  // in four quarters
      out.limit = LimitKind::kJerk;
      robot.limits.max_jerk = share * 32.0 * delta / (T * T * T);
      break;
    case 3: {
      out.limit = LimitKind::kSeparation;
      const std::size_t other = out.robot == 0 ? 1 : 0;
      Robot& near = out.problem.robots[other];
      near = robot;
      near.name = "near";
      near.start.p.x() += 3.0 * robot.limits.collision_radius;
      near.goal.state.p.y() += share * 2.0 * robot.limits.collision_radius;
      break;
    }
    default:
      out.limit = LimitKind::kObstacle;
      out.problem.obstacles = std::make_shared<RoundObstacles>(
          std::vector<RoundObstacle>{{robot.goal.state.p, 0.3, false}});
  }
  return out;
}

}  // namespace trident::benchmarks
