// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// nav_people CROSSING.yaml: drives a robot through a hall with walkers, once for each seed, and
// prints a line of JSON for each crossing. Exits with 2 when the input is wrong.
#include <exception>
#include <iostream>

#include <nlohmann/json.hpp>

#include "crossing.h"
#include "navigation_stack.h"
#include "trident_base/yaml_config.h"

namespace {

namespace bench = trident::benchmarks;
using nlohmann::json;

json json_of(const bench::Touch& touch) {
  return {{"time_s", touch.time_s},
          {"walker", touch.walker},
          {"own_speed_m_s", touch.own_speed_m_s},
          {"last_s", touch.last_s},
          {"is_pushed", touch.is_pushed}};
}

json json_of(const bench::CrossingFrame& frame) {
  json walkers = json::array(), tracks = json::array();
  for (const auto& p : frame.walkers) walkers.push_back({p.x, p.y});
  for (const auto& t : frame.tracks) {
    tracks.push_back({t.position.x, t.position.y, t.velocity.x, t.velocity.y, t.radius_m});
  }
  return {{"time_s", frame.time_s},
          {"robot", {frame.robot.x, frame.robot.y, frame.robot.yaw}},
          {"command", {frame.command.vx, frame.command.vy, frame.command.wz}},
          {"walkers", walkers},
          {"tracks", tracks}};
}

json json_of(std::uint64_t seed, const bench::CrossingResult& result) {
  json touches = json::array(), frames = json::array();
  for (const auto& touch : result.touches) touches.push_back(json_of(touch));
  for (const auto& frame : result.frames) frames.push_back(json_of(frame));
  return {{"seed", seed},
          {"has_arrived", result.has_arrived},
          {"time_s", result.time_s},
          {"text", result.text},
          {"touches", touches},
          {"wall", result.wall},
          {"recoveries", result.recoveries},
          {"navigation_cpu_s", result.navigation_cpu_s},
          {"frames", frames}};
}

int run(const std::string& file) {
  const auto config = trident::load_yaml<bench::CrossingConfig>(file);
  const trident::ConfigNode parameters = bench::merged_parameters(config.trial.parameters);
  for (const std::uint64_t seed : config.trial.seeds) {
    std::cout << json_of(seed, bench::run_crossing(config, parameters, seed)) << std::endl;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "legal: nav_people CROSSING.yaml\n";
    return 2;
  }
  try {
    return run(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << "nav_people: " << error.what() << "\n";
    return 2;
  }
}
