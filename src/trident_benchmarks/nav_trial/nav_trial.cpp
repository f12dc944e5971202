// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// nav_trial TRIAL.yaml: drives a robot to a goal in a simulated world, once for each seed, and
// prints a line of JSON for each run. Exits with 2 when the input is wrong.
#include <cstdio>
#include <exception>
#include <iostream>

#include <nlohmann/json.hpp>

#include "navigation_stack.h"
#include "trial.h"
#include "trident_base/error.h"
#include "trident_base/yaml_config.h"

namespace {

namespace bench = trident::benchmarks;

nlohmann::json json_of(const bench::GoalResult& tried) {
  return {{"goal", {tried.goal.x, tried.goal.y, tried.goal.yaw}},
          {"end", bench::name_of(tried.end)},
          {"text", tried.text},
          {"time_s", tried.time_s},
          {"position_error_m", tried.position_error_m},
          {"heading_error_rad", tried.heading_error_rad},
          {"touched", tried.touched},
          {"recoveries", tried.recoveries}};
}

nlohmann::json json_of(std::uint64_t seed, const bench::TrialResult& result) {
  nlohmann::json track = nlohmann::json::array();
  for (const trident::nav::Pose2& pose : result.track) track.push_back({pose.x, pose.y, pose.yaw});
  nlohmann::json goals = nlohmann::json::array();
  for (const bench::GoalResult& tried : result.goals) goals.push_back(json_of(tried));
  return {{"seed", seed},
          {"goals", goals},
          {"localization_error_m", result.localization_error_m},
          {"end", bench::name_of(result.end)},
          {"time_s", result.time_s},
          {"text", result.text},
          {"recoveries", result.recoveries},
          {"odometry_error_m", result.odometry_error_m},
          {"top_speed_m_s", result.top_speed_m_s},
          {"least_speed_m_s", result.least_speed_m_s},
          {"navigation_cpu_s", result.navigation_cpu_s},
          {"track", track}};
}

int run(const std::string& file) {
  const auto config = trident::load_yaml<bench::TrialConfig>(file);
  const trident::ConfigNode parameters = bench::merged_parameters(config.parameters);
  const bench::NavigationStack stack(parameters);
  for (const std::string& warning : stack.warnings()) std::cerr << "nav_trial: " << warning << "\n";
  for (const std::uint64_t seed : config.seeds) {
    std::cout << json_of(seed, bench::run_trial(config, parameters, seed)) << std::endl;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "legal: nav_trial TRIAL.yaml\n";
    return 2;
  }
  try {
    return run(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << "nav_trial: " << error.what() << "\n";
    return 2;
  }
}
