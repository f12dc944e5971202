// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// nav_drive_pains silence|near_goals CONFIG.yaml: a robot in a simulated world whose lidar falls
// silent, or that has goals near itself; a line of JSON for each seed. Exits with 2 when the input
// is wrong.
#include <exception>
#include <iostream>

#include <nlohmann/json.hpp>

#include "drive_pains.h"
#include "navigation_stack.h"
#include "trident_base/error.h"
#include "trident_base/yaml_config.h"

namespace {

namespace bench = trident::benchmarks;
using nlohmann::json;

json json_of(const bench::Silence& silence) {
  return {{"speed_m_s", silence.speed_m_s},   {"stopped_s", silence.stopped_s},
          {"traveled_m", silence.traveled_m}, {"moved_later_m", silence.moved_later_m},
          {"waiting", silence.waiting},       {"has_continued", silence.has_continued}};
}

json json_of(const std::vector<bench::NearGoal>& goals) {
  json list = json::array();
  for (const auto& goal : goals) {
    list.push_back({{"distance_m", goal.distance_m},
                    {"bearing_rad", goal.bearing_rad},
                    {"turn_rad", goal.turn_rad},
                    {"is_reached", goal.is_reached},
                    {"time_s", goal.time_s},
                    {"recoveries", goal.recoveries},
                    {"overshoot_m", goal.overshoot_m},
                    {"text", goal.text}});
  }
  return {{"goals", list}};
}

int run(const std::string& scene, const std::string& file) {
  const auto config = trident::load_yaml<bench::DrivePainConfig>(file);
  const trident::ConfigNode parameters = bench::merged_parameters(config.trial.parameters);
  if (scene != "silence" && scene != "near_goals") {
    throw trident::Error("scene " + scene + ", legal: silence, near_goals");
  }
  for (const std::uint64_t seed : config.trial.seeds) {
    json row = scene == "silence" ? json_of(bench::fall_silent(config, parameters, seed))
                                  : json_of(bench::drive_near_goals(config, parameters, seed));
    row["seed"] = seed;
    std::cout << row << std::endl;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "legal: nav_drive_pains silence|near_goals CONFIG.yaml\n";
    return 2;
  }
  try {
    return run(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::cerr << "nav_drive_pains: " << error.what() << "\n";
    return 2;
  }
}
