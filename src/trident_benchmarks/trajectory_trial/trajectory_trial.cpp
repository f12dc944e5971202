// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// trajectory_trial speed RUNS | optimum STARTS | random FIRST COUNT | infeasible FIRST COUNT |
// picture: plans for teams, and prints a line of JSON for each. Exits with 2 when the input is
// wrong.
#include <algorithm>
#include <ctime>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "priority_planner.h"
#include "sampled_check.h"
#include "team_scenes.h"
#include "trident_trajectories/optimize.h"

namespace {

namespace bench = trident::benchmarks;
namespace plan = trident::trajectories;
using nlohmann::json;

constexpr double kRate_Hz = 1000.0;
constexpr double kStep_s = 0.5;  // of a receding horizon

/// CPU time of this thread [s].
double cpu_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double excess(const plan::Problem& problem, const plan::Solution& solution) {
  std::vector<bench::Path> paths;
  for (const auto& trajectory : solution.trajectories) paths.push_back(bench::path_of(trajectory));
  return bench::sampled_excess(problem, paths, solution.trajectories.front().duration(), kRate_Hz);
}

json timed(const std::string& name, const plan::Problem& problem,
           const plan::OptimizeOptions& options, int runs) {
  std::vector<double> times;
  plan::Solution solution;
  for (int i = 0; i < runs; ++i) {
    const double begin = cpu_s();
    solution = plan::optimize(problem, options);
    times.push_back(cpu_s() - begin);
  }
  std::sort(times.begin(), times.end());
  return {{"case", name},
          {"method", options.method},
          {"cpu_ms", 1e3 * times[times.size() / 2]},
          {"worst_cpu_ms", 1e3 * times.back()},
          {"is_feasible", solution.is_feasible},
          {"jerk", solution.jerk},
          {"start", solution.start},
          {"evaluations", solution.evaluations},
          {"excess", excess(problem, solution)}};
}

/// One step of a receding horizon: the team half a second later, from where its plan has led it.
json receding(int runs) {
  plan::Problem problem = bench::field_crossing();
  plan::OptimizeOptions options;
  const plan::Solution first = plan::optimize(problem, options);
  for (std::size_t i = 0; i < problem.robots.size(); ++i) {
    problem.robots[i].start = first.trajectories[i].at(kStep_s);
    options.warm_start.push_back(plan::rest_of(first.trajectories[i], kStep_s));
  }
  problem.durations[0].value -= kStep_s;
  json row = timed("receding step, 8 robots, 50 obstacles", problem, options, runs);
  row["first_is_feasible"] = first.is_feasible;
  return row;
}

void measure_speed(int runs) {
  const plan::OptimizeOptions options;
  for (const int robots : {6, 12, 30})
    std::cout << timed("swap of " + std::to_string(robots), bench::antipodal_swap(robots), options,
                       runs)
              << std::endl;
  std::cout << timed("rendezvous of three", bench::three_platform_rendezvous(), options, runs)
            << std::endl;
  std::cout << timed("landing on a moving boat", bench::moving_boat_landing(), options, runs)
            << std::endl;
  std::cout << receding(runs) << std::endl;
  plan::OptimizeOptions mma;
  mma.method = "mma";
  std::cout << timed("swap of 6", bench::antipodal_swap(6), mma, runs) << std::endl;
}

/// The default's cost next to the best of many random starts of another method.
void measure_optimum(int starts) {
  const plan::Problem problem = bench::antipodal_swap(6);
  const double own = plan::optimize(problem).jerk;
  plan::OptimizeOptions options;
  options.method = "slsqp";
  options.explain = false;
  options.starts = {plan::Start::kRandom};
  for (int i = 0; i < starts; ++i) {
    options.seed = static_cast<std::uint64_t>(i);
    const plan::Solution solution = plan::optimize(problem, options);
    std::cout << json{{"seed", i},
                      {"jerk", solution.jerk},
                      {"is_feasible", solution.is_feasible},
                      {"default_jerk", own}}
              << std::endl;
  }
}

json random_row(std::uint64_t seed) {
  const plan::Problem problem = bench::random_team(seed);
  plan::OptimizeOptions options;
  options.explain = false;
  const double begin = cpu_s();
  const plan::Solution solution = plan::optimize(problem, options);
  const double spent = cpu_s() - begin;
  return {{"seed", seed},
          {"robots", problem.robots.size()},
          {"is_feasible", solution.is_feasible},
          {"is_shown_feasible", bench::plan_by_priorities(problem).has_value()},
          {"excess", excess(problem, solution)},
          {"start", solution.start},
          {"message", solution.message},
          {"cpu_ms", 1e3 * spent}};
}

json infeasible_row(std::uint64_t seed) {
  const bench::InfeasibleTeam team = bench::infeasible_team(seed);
  const plan::Solution solution = plan::optimize(team.problem);
  json row = {{"seed", seed},
              {"planted", plan::name_of(team.limit)},
              {"is_feasible", solution.is_feasible},
              {"message", solution.message}};
  if (solution.violations.empty()) return row;
  const plan::Violation& named = solution.violations.front();
  const auto& robots = named.robots;
  row["named"] = plan::name_of(named.limit);
  row["is_true"] = named.limit == team.limit &&
                   std::find(robots.begin(), robots.end(), team.robot) != robots.end();
  return row;
}

json picture_of(const std::string& name, const plan::Problem& problem) {
  constexpr int kInstants = 120;
  const plan::Solution solution = plan::optimize(problem);
  json robots = json::array();
  for (std::size_t i = 0; i < solution.trajectories.size(); ++i) {
    const plan::Trajectory& trajectory = solution.trajectories[i];
    json points = json::array();
    for (int k = 0; k <= kInstants; ++k) {
      const double t = trajectory.duration() * k / kInstants;
      const Eigen::Vector3d p = trajectory.at(t).p;
      points.push_back({t, p.x(), p.y(), p.z()});
    }
    robots.push_back({{"name", problem.robots[i].name},
                      {"kind", plan::name_of(problem.robots[i].kind)},
                      {"points", points}});
  }
  return {{"case", name}, {"robots", robots}};
}

int number(const std::vector<std::string>& words, std::size_t i) {
  if (i >= words.size()) throw std::invalid_argument("a number is missing");
  return std::stoi(words[i]);
}

int run(const std::vector<std::string>& words) {
  const std::string what = words.empty() ? "" : words[0];
  if (what == "speed") {
    measure_speed(number(words, 1));
  } else if (what == "optimum") {
    measure_optimum(number(words, 1));
  } else if (what == "random" || what == "infeasible") {
    const int first = number(words, 1), count = number(words, 2);
    for (int seed = first; seed < first + count; ++seed)
      std::cout << (what == "random" ? random_row(seed) : infeasible_row(seed)) << std::endl;
  } else if (what == "picture") {
    std::cout << picture_of("swap of 6", bench::antipodal_swap(6)) << std::endl;
    std::cout << picture_of("rendezvous of three", bench::three_platform_rendezvous()) << std::endl;
  } else {
    std::cerr << "legal: trajectory_trial speed RUNS | optimum STARTS | random FIRST COUNT | "
                 "infeasible FIRST COUNT | picture\n";
    return 2;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(std::vector<std::string>(argv + 1, argv + argc));
  } catch (const std::exception& error) {
    std::cerr << "trajectory_trial: " << error.what() << "\n";
    return 2;
  }
}
