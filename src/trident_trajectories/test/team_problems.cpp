// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "team_problems.h"

#include <cmath>
#include <memory>

#include "trident_base/angle.h"

namespace trident::trajectories {

Problem antipodal_swap(int robots) {
  Problem problem;
  problem.durations[0].value = 6.0;
  for (int i = 0; i < robots; ++i) {
    const double angle = 2.0 * kPi * i / robots;
    const Eigen::Vector3d place(8.0 * std::cos(angle), 8.0 * std::sin(angle), 0.0);
    Robot robot;
    robot.name = "uav" + std::to_string(i);
    robot.start.p = place + Eigen::Vector3d(0.0, 0.0, 5.0);
    robot.goal.state.p = -place + Eigen::Vector3d(0.0, 0.0, 5.0);
    robot.limits.max_velocity = 6.0;
    robot.limits.max_acceleration = 5.0;
    robot.limits.collision_radius = 0.75;
    problem.robots.push_back(robot);
  }
  return problem;
}

Problem three_platforms() {
  Robot uav, ugv, usv;
  uav.name = "uav";
  uav.start.p = {0.0, 0.0, 5.0};
  uav.goal.state.p = {0.0, 0.0, 5.0};
  uav.limits.max_velocity = 4.0;
  uav.limits.max_acceleration = 3.0;
  uav.limits.max_jerk = 20.0;
  ugv.name = "ugv";
  ugv.kind = Kind::kUnicycle;
  ugv.start.p = {-10.0, 3.0, 0.0};
  ugv.goal.state.p = {-1.5, 0.0, 0.0};
  ugv.limits.max_acceleration = 1.0;
  ugv.limits.max_turn_rate = 1.0;
  usv.name = "usv";
  usv.kind = Kind::kVessel;
  usv.start.p = {8.0, -6.0, 0.0};
  usv.goal.state.p = {1.5, 0.0, 0.0};
  usv.limits.max_velocity = 3.0;
  usv.limits.max_turn_rate = 0.5;
  usv.limits.collision_radius = 2.0;
  usv.limits.max_thrust = 500.0;
  usv.surge = {300.0, 50.0, 60.0, {0.2, 0.0}};
  Problem problem;
  problem.durations[0].value = 10.0;
  problem.places = {Eigen::Vector3d::Zero()};
  for (Robot* robot : {&uav, &ugv, &usv}) {
    robot->goal.place = 0;
    problem.robots.push_back(*robot);
  }
  return problem;
}

Problem everything() {
  Problem problem = three_platforms();
  problem.durations = {{10.0, 5.0, 20.0, true}, {8.0, 4.0, 16.0, true}};
  problem.cost = {0.4, 0.2, 0.3, 0.1};
  problem.downwash = 2.0;
  problem.min_height = 4.9;
  problem.obstacles = std::make_shared<RoundObstacles>(
      std::vector<RoundObstacle>{{{-5.0, 1.0, 0.0}, 0.5, true}, {{2.0, 3.0, 4.0}, 1.0, false}});
  problem.moving.push_back({"person",
                            Prediction({{0.0, {-8.0, 0.0, 0.0}, {0.5, 0.3, 0.0}},
                                        {6.0, {-4.0, 3.0, 0.0}, {1.0, 0.0, 0.0}}}),
                            0.4});
  problem.rendezvous.push_back({0, 1, {1.0, 1.0, 5.0}, 0.2, 0.4});
  Robot landing;
  landing.name = "landing";
  landing.duration = 1;
  landing.start = {{-6.0, 6.0, 8.0}, {0.5, 0.0, 0.1}, {0.1, 0.0, 0.0}};
  landing.goal.state.p = {0.0, 0.0, 0.8};
  landing.goal.deck = std::make_shared<Prediction>(std::vector<Prediction::Knot>{
      {0.0, {0.0, 5.0, 1.0}, {1.0, 0.0, 0.1}}, {15.0, {14.0, 6.0, 1.2}, {1.0, 0.2, -0.1}}});
  landing.limits.max_jerk = 10.0;
  problem.robots.push_back(landing);
  Robot car;
  car.name = "car";
  car.kind = Kind::kAckermann;
  car.duration = 1;
  car.start = {{-9.0, -4.0, 0.0}, {0.4, 0.2, 0.0}, {0.0, 0.0, 0.0}};
  car.goal.state.p = {-1.0, -7.0, 0.0};
  car.limits.min_turning_radius = 1.5;
  problem.robots.push_back(car);
  problem.order.push_back({3, 0, 0.5});
  return problem;
}

}  // namespace trident::trajectories
