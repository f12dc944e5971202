// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_trajectories_ros/trajectory_request.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>

#include "trident_base/error.h"
#include "trident_ros/message_checks.h"
#include "trident_trajectories/certificate.h"

namespace trident::trajectories {
namespace {

using Request = trident_msgs::OptimizeTrajectories::Request;
using Response = trident_msgs::OptimizeTrajectories::Response;

constexpr double kLongest_s = 3600.0;    // of a path
constexpr std::size_t kMaxRobots = 100;  // of a request
constexpr double kStep_s = 0.05;         // between the samples of an answer

Eigen::Vector3d vector_of(const geometry_msgs::Point& p) { return {p.x, p.y, p.z}; }
Eigen::Vector3d vector_of(const geometry_msgs::Vector3& v) { return {v.x, v.y, v.z}; }

void check_sizes(const trident_msgs::TimedPath& path, const std::string& where) {
  const std::string times = std::to_string(path.times.size());
  if (path.times.size() < 2 || path.poses.size() != path.times.size())
    throw Error(where + times + " times and " + std::to_string(path.poses.size()) +
                " poses; legal are as many of both, 2 or more");
  if (!path.twists.empty() && path.twists.size() != path.times.size())
    throw Error(where + std::to_string(path.twists.size()) + " twists; legal are 0 or " + times);
}

void check_times(const std::vector<double>& times, const std::string& where) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]) || (i > 0 && times[i] <= times[i - 1]))
      throw Error(where + "times[" + std::to_string(i) + "] is " + std::to_string(times[i]) +
                  "; legal are finite times that grow");
  }
  if (times.back() > kLongest_s)
    throw Error(where + "the last time is " + std::to_string(times.back()) +
                "; legal is <= " + std::to_string(kLongest_s));
}

void check_path(const trident_msgs::TimedPath& path) {
  const std::string where = "path of '" + path.robot + "': ";
  check_sizes(path, where);
  check_times(path.times, where);
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    const std::string problem =
        ros_utils::rotation_problem(path.poses[i].orientation, "orientation", 1.0);
    if (!problem.empty()) throw Error(where + "poses[" + std::to_string(i) + "]: " + problem);
  }
  if (path.times.front() < 0.0)
    throw Error(where + "times[0] is " + std::to_string(path.times.front()) + "; legal is >= 0");
}

/// 0 is no limit.
double limit_of(double value) { return value == 0.0 ? kUnlimited : value; }

const trident_msgs::TrajectoryLimits& limits_of(const Request& request, const std::string& robot) {
  for (const auto& limits : request.limits)
    if (limits.robot == robot) return limits;
  throw Error("limits: none of '" + robot + "'; legal is one for each robot of the initial paths");
}

MotionState state_of(const trident_msgs::TimedPath& path, std::size_t i) {
  MotionState state;
  state.p = vector_of(path.poses[i].position);
  if (!path.twists.empty()) state.v = vector_of(path.twists[i].linear);
  return state;
}

Robot robot_of(const trident_msgs::TimedPath& path, const trident_msgs::TrajectoryLimits& limits) {
  Robot robot;
  robot.name = path.robot;
  robot.kind = kind_of_name(path.kind);
  robot.start = state_of(path, 0);
  robot.goal.state = state_of(path, path.times.size() - 1);
  robot.limits.max_velocity = limits.max_velocity;
  robot.limits.max_acceleration = limit_of(limits.max_acceleration);
  robot.limits.max_jerk = limit_of(limits.max_jerk);
  robot.limits.max_turn_rate = limit_of(limits.max_turn_rate);
  robot.limits.collision_radius = limits.collision_radius;
  return robot;
}

/// The index of a duration of that value, which is added where it is absent.
std::size_t duration_of(double value, bool is_free, std::vector<Duration>& durations) {
  for (std::size_t i = 0; i < durations.size(); ++i)
    if (durations[i].value == value) return i;
  Duration duration;
  duration.value = value;
  duration.is_free = is_free;
  durations.push_back(duration);
  return durations.size() - 1;
}

std::size_t index_of(const Problem& problem, const std::string& name) {
  for (std::size_t i = 0; i < problem.robots.size(); ++i)
    if (problem.robots[i].name == name) return i;
  throw Error("constraints: rendezvous: robot is '" + name + "'; legal are those of the paths");
}

/// Goals become places about their mean, which may move.
void make_place(Problem& problem) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Robot& robot : problem.robots) middle += robot.goal.state.p;
  middle /= static_cast<double>(problem.robots.size());
  middle.z() = 0.0;
  problem.places = {middle};
  for (Robot& robot : problem.robots) {
    robot.goal.place = 0;
    robot.goal.state.p -= middle;
  }
}

void add_constraints(const RequestedConstraints& wanted, Problem& problem) {
  problem.cost = cost_of_name(wanted.cost);
  problem.downwash = wanted.downwash;
  problem.min_height = wanted.min_height;
  std::vector<RoundObstacle> round;
  for (const RequestedObstacle& obstacle : wanted.obstacles)
    round.push_back({obstacle.center, obstacle.radius, !obstacle.sphere});
  if (!round.empty()) problem.obstacles = std::make_shared<RoundObstacles>(round);
  for (const RequestedRendezvous& pair : wanted.rendezvous)
    problem.rendezvous.push_back({index_of(problem, pair.first), index_of(problem, pair.second),
                                  pair.offset, pair.tolerance, pair.fraction});
  if (wanted.free_place) make_place(problem);
}

geometry_msgs::Pose pose_of(const MotionState& state, const geometry_msgs::Pose& like) {
  geometry_msgs::Pose pose = like;
  pose.position.x = state.p.x();
  pose.position.y = state.p.y();
  pose.position.z = state.p.z();
  if (state.v.head<2>().norm() < 1e-3) return pose;
  const double yaw = std::atan2(state.v.y(), state.v.x());
  pose.orientation.x = pose.orientation.y = 0.0;
  pose.orientation.z = std::sin(0.5 * yaw);
  pose.orientation.w = std::cos(0.5 * yaw);
  return pose;
}

void fill(const Problem& problem, const Solution& solution, const Request& request,
          Response& response) {
  response.success = solution.is_feasible;
  response.message = solution.message;
  response.cost = solution.cost;
  const std::vector<Violation> all = violations(problem, solution.trajectories, 1.0);
  response.worst_violation = all.empty() ? -1.0 : all.front().relative;
  if (!solution.violations.empty()) response.violated = name_of(solution.violations.front().limit);
  for (std::size_t i = 0; i < solution.trajectories.size(); ++i)
    response.result.push_back(path_of(solution.trajectories[i], request.initial[i], kStep_s));
}

}  // namespace

Problem problem_of(const Request& request, OptimizeOptions& options) {
  const RequestedConstraints wanted =
      request.constraints.empty()
          ? RequestedConstraints{}
          : load_yaml_string<RequestedConstraints>(request.constraints, "constraints");
  if (!request.method.empty()) options.method = request.method;
  options.segments = wanted.segments;
  Problem problem;
  problem.durations.clear();
  for (const trident_msgs::TimedPath& path : request.initial) {
    check_path(path);
    Robot robot = robot_of(path, limits_of(request, path.robot));
    robot.duration = duration_of(path.times.back() - path.times.front(), wanted.free_durations,
                                 problem.durations);
    problem.robots.push_back(robot);
  }
  if (problem.robots.size() > kMaxRobots)
    throw Error("initial: " + std::to_string(problem.robots.size()) + " paths; legal are 1 ... " +
                std::to_string(kMaxRobots));
  if (problem.robots.empty()) throw Error("initial: no path; legal are 1 or more");
  add_constraints(wanted, problem);
  return problem;
}

trident_msgs::TimedPath path_of(const Trajectory& trajectory,
                                const trident_msgs::TimedPath& initial, double step_s) {
  trident_msgs::TimedPath path;
  path.header = initial.header;
  path.robot = initial.robot;
  path.kind = initial.kind;
  const int steps = std::max(1, static_cast<int>(std::ceil(trajectory.duration() / step_s)));
  for (int k = 0; k <= steps; ++k) {
    const double t = trajectory.duration() * k / steps;
    const MotionState state = trajectory.at(t);
    geometry_msgs::Twist twist;
    twist.linear.x = state.v.x();
    twist.linear.y = state.v.y();
    twist.linear.z = state.v.z();
    path.times.push_back(initial.times.front() + t);
    path.poses.push_back(
        pose_of(state, path.poses.empty() ? initial.poses.front() : path.poses.back()));
    path.twists.push_back(twist);
  }
  return path;
}

Response answer(const Request& request, bool& is_refused) {
  const auto begin = std::chrono::steady_clock::now();
  Response response;
  is_refused = false;
  try {
    OptimizeOptions options;
    const Problem problem = problem_of(request, options);
    fill(problem, optimize(problem, options), request, response);
  } catch (const Error& error) {
    response.message = error.what();
    is_refused = true;
  }
  response.solve_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return response;
}

}  // namespace trident::trajectories
