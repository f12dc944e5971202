// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_trajectories_ros/trajectory_request.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace trident::trajectories {
namespace {

using Request = trident_msgs::OptimizeTrajectories::Request;

trident_msgs::TimedPath path(const std::string& robot, double x, double y) {
  trident_msgs::TimedPath out;
  out.robot = robot;
  out.kind = "uav";
  out.times = {0.0, 6.0};
  out.poses.resize(2);
  out.poses[0].position.x = x;
  out.poses[0].position.y = y;
  out.poses[1].position.x = -x;
  out.poses[1].position.y = -y;
  for (auto& pose : out.poses) {
    pose.position.z = 5.0;
    pose.orientation.w = 1.0;
  }
  return out;
}

Request swap_of_two() {
  Request request;
  request.initial = {path("a", 6.0, 0.0), path("b", -6.0, 0.0)};
  for (const auto& one : request.initial) {
    trident_msgs::TrajectoryLimits limits;
    limits.robot = one.robot;
    limits.max_velocity = 5.0;
    limits.collision_radius = 0.5;
    request.limits.push_back(limits);
  }
  return request;
}

std::string refusal(const Request& request) {
  bool is_refused = false;
  const auto response = answer(request, is_refused);
  EXPECT_TRUE(is_refused);
  EXPECT_FALSE(response.success);
  return response.message;
}

TEST(TrajectoryRequest, AnswersWithPathsThatBeginAndEndWhereTheyShould) {
  bool is_refused = true;
  const auto response = answer(swap_of_two(), is_refused);
  EXPECT_FALSE(is_refused);
  ASSERT_TRUE(response.success) << response.message;
  ASSERT_EQ(response.result.size(), 2u);
  EXPECT_LE(response.worst_violation, 1e-4);
  const auto& a = response.result[0];
  EXPECT_EQ(a.robot, "a");
  EXPECT_NEAR(a.poses.front().position.x, 6.0, 1e-9);
  EXPECT_NEAR(a.poses.back().position.x, -6.0, 1e-9);
  EXPECT_NEAR(a.times.back(), 6.0, 1e-9);
  EXPECT_EQ(a.poses.size(), a.twists.size());
}

TEST(TrajectoryRequest, ReadsConstraints) {
  Request request = swap_of_two();
  request.constraints =
      "{cost: mixed, free_durations: true, downwash: 2.0, min_height: 1.0,"
      " obstacles: [{center: [0, 3, 0], radius: 0.5}],"
      " rendezvous: [{first: a, second: b, offset: [0, 2, 0], fraction: 0.4}]}";
  OptimizeOptions options;
  const Problem problem = problem_of(request, options);
  EXPECT_EQ(problem.durations.size(), 1u);
  EXPECT_TRUE(problem.durations[0].is_free);
  EXPECT_EQ(problem.downwash, 2.0);
  ASSERT_EQ(problem.rendezvous.size(), 1u);
  EXPECT_EQ(problem.rendezvous[0].second, 1u);
  EXPECT_TRUE(problem.obstacles != nullptr);
}

TEST(TrajectoryRequest, AnInfeasibleTeamIsAnAnswerThatNamesTheLimit) {
  Request request = swap_of_two();
  request.limits[1].max_velocity = 1.5;
  bool is_refused = true;
  const auto response = answer(request, is_refused);
  EXPECT_FALSE(is_refused);
  EXPECT_FALSE(response.success);
  EXPECT_EQ(response.violated, "max_velocity");
  EXPECT_NE(response.message.find("'b'"), std::string::npos) << response.message;
}

TEST(TrajectoryRequest, RefusesWhatIsNotLegalWithItsName) {
  Request request = swap_of_two();
  request.initial[0].times = {0.0, 0.0};
  EXPECT_EQ(refusal(request),
            "path of 'a': times[1] is 0.000000; legal are finite times that grow");
  request = swap_of_two();
  request.initial[1].kind = "train";
  EXPECT_EQ(refusal(request),
            "kind is 'train'; legal are uav, unicycle, ackermann, vessel, ugv, usv");
  request = swap_of_two();
  request.initial[1].poses[0].position.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(request), "robot 'b' start: position.y is nan; legal is -1e6 ... 1e6");
  request = swap_of_two();
  request.limits.pop_back();
  EXPECT_EQ(refusal(request),
            "limits: none of 'b'; legal is one for each robot of the initial paths");
  request = swap_of_two();
  request.constraints = "{colour: red}";
  EXPECT_NE(refusal(request).find("colour"), std::string::npos);
}

}  // namespace
}  // namespace trident::trajectories
