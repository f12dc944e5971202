// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// nav_plan MAP.yaml X,Y,YAW X,Y,YAW [--planner NAME] [--params YAML] [--costmap YAML]
// [--turning-radius M] [--grid FILE.pgm] [--obstacles X,Y,RADIUS;...] [--controller NAME
// [--controller-params YAML] [--speed V]]: plans on a map and prints the outcome as JSON; --grid
// gets the costmap's bytes, row 0 at the bottom; the sources of obstacle and voxel layers see round
// obstacles that the map does not have; with --controller the JSON has what that weighs at the
// start of the path, for a robot that already drives at that speed. Exits with 0 when there is a
// path, with 1 when there is not, with 2 when the input is wrong.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/yaml_config.h"
#include "trident_maps/map_file.h"
#include "trident_nav/control/controller.h"
#include "trident_nav/core/footprint.h"
#include "trident_nav/costmap/beam_layer.h"
#include "trident_nav/costmap/costmap.h"
#include "trident_nav/costmap/costmap_config.h"
#include "trident_nav/costmap/layer_factory.h"
#include "trident_nav/costmap/static_layer.h"
#include "trident_nav/planning/planner_registry.h"

namespace {

using trident::Error;
using trident::nav::CostGrid;
using trident::nav::Costmap;
using trident::nav::PlanOutcome;
using trident::nav::Pose2;

struct Arguments {
  std::string map;
  Pose2 start, goal;
  std::map<std::string, std::string> options{
      {"planner", "nav2_smac_planner/SmacPlannerHybrid"},
      {"params", "{}"},
      {"costmap",
       "{plugins: [{name: static, type: costmap_2d::StaticLayer}, {name: inflation, type: "
       "costmap_2d::InflationLayer}]}"},
      {"turning-radius", "0"},
      {"grid", ""},
      {"obstacles", ""},
      {"controller", ""},
      {"controller-params", "{}"},
      {"speed", "0.5"}};
};

Pose2 parse_pose(const std::string& text) {
  Pose2 pose;
  int used = 0;
  const int count = std::sscanf(text.c_str(), "%lf,%lf,%lf%n", &pose.x, &pose.y, &pose.yaw, &used);
  if (count != 3 || static_cast<std::size_t>(used) != text.size()) {
    throw Error("pose: " + text + ", legal: X,Y,YAW [m, rad]");
  }
  return pose;
}

Arguments parse_arguments(int argc, char** argv) {
  Arguments result;
  if (argc < 4 || argc % 2 != 0) {
    throw Error("legal: nav_plan MAP.yaml X,Y,YAW X,Y,YAW [--OPTION VALUE ...]");
  }
  result.map = argv[1];
  result.start = parse_pose(argv[2]);
  result.goal = parse_pose(argv[3]);
  for (int i = 4; i < argc; i += 2) {
    const std::string word = argv[i];
    const auto found = result.options.find(word.substr(word.find_first_not_of('-')));
    if (word.rfind("--", 0) != 0 || found == result.options.end()) {
      throw Error(word +
                  ": legal: --planner, --params, --costmap, --turning-radius, --grid, --obstacles, "
                  "--controller, --controller-params, --speed");
    }
    found->second = argv[i + 1];
  }
  return result;
}

/// A round obstacle [m].
struct Disc {
  double x = 0.0, y = 0.0, radius = 0.0;
};

bool is_legal(const Disc& disc) {
  constexpr double kLargest_m = 100.0;
  return std::isfinite(disc.x) && std::isfinite(disc.y) && disc.radius > 0.0 &&
         disc.radius <= kLargest_m;
}

Disc parse_disc(const std::string& word) {
  Disc disc;
  int used = 0;
  const int count =
      std::sscanf(word.c_str(), "%lf,%lf,%lf%n", &disc.x, &disc.y, &disc.radius, &used);
  const bool is_whole = count == 3 && static_cast<std::size_t>(used) == word.size();
  if (!is_whole || !is_legal(disc)) {
    throw Error("obstacle: " + word + ", legal: X,Y,RADIUS [m], RADIUS > 0 and <= 100");
  }
  return disc;
}

/// The rims of round obstacles, each with points a centimeter apart.
std::vector<Eigen::Vector3f> rims(const std::string& text) {
  constexpr double kApart_m = 0.01;
  std::vector<Eigen::Vector3f> points;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ';');) {
    const Disc disc = parse_disc(word);
    const int steps = std::max(8, static_cast<int>(2.0 * trident::kPi * disc.radius / kApart_m));
    for (int i = 0; i < steps; ++i) {
      const double angle = 2.0 * trident::kPi * i / steps;
      points.push_back(Eigen::Vector3d(disc.x + disc.radius * std::cos(angle),
                                       disc.y + disc.radius * std::sin(angle), 0.0)
                           .cast<float>());
    }
  }
  return points;
}

/// Lets all sources of layers see the obstacles.
void show_obstacles(const Arguments& arguments, Costmap& costmap) {
  const std::vector<Eigen::Vector3f> points = rims(arguments.options.at("obstacles"));
  if (points.empty()) return;
  for (const auto& layer : costmap.layers()) {
    auto* beams = dynamic_cast<trident::nav::BeamLayer*>(layer.get());
    if (beams == nullptr) continue;
    for (auto& source : beams->sources()) {
      source.add(trident::nav::observe_points(0.0, points, trident::SE3()));
    }
  }
}

Costmap make_costmap(const Arguments& arguments) {
  trident::Registry<trident::nav::LayerType> layers("costmap layer");
  trident::nav::register_builtin_layers(layers);
  trident::nav::CostmapConfigSource source;
  source.label = "--costmap";
  source.path = "/costmap";
  const auto config = trident::nav::read_costmap_config(
      trident::parse_yaml(arguments.options.at("costmap"), "--costmap"), source, layers);
  for (const std::string& warning : config.warnings) std::cerr << warning << "\n";
  Costmap costmap(config.params, trident::nav::make_layers(config, layers));
  const auto map = trident::maps::load_map(arguments.map);
  bool has_map = false;
  for (const auto& layer : costmap.layers()) {
    auto* fixed = dynamic_cast<trident::nav::StaticLayer*>(layer.get());
    if (fixed == nullptr) continue;
    fixed->set_map(map);
    has_map = true;
  }
  if (!has_map) throw Error("--costmap: plugins: legal: a list with a StaticLayer");
  show_obstacles(arguments, costmap);
  costmap.update({0.0, arguments.start});
  return costmap;
}

void write_grid(const CostGrid& grid, const std::string& path) {
  std::ofstream file(path, std::ios::binary);
  file << "P5\n" << grid.geometry.width << " " << grid.geometry.height << "\n255\n";
  for (int y = grid.geometry.height; y-- > 0;) {
    const auto* row = reinterpret_cast<const char*>(grid.cost + grid.geometry.index({0, y}));
    file.write(row, grid.geometry.width);
  }
  if (!file.flush()) throw Error(path + ": cannot be written");
}

nlohmann::json to_json(const PlanOutcome& outcome, const CostGrid& grid,
                       const trident::nav::Footprint& footprint, double time_s) {
  nlohmann::json json;
  json["found"] = outcome.failure == trident::nav::Failure::kNone;
  json["reason"] = outcome.reason;
  json["cost"] = outcome.cost;
  json["time_s"] = time_s;
  json["resolution_m"] = grid.geometry.resolution;
  json["origin_m"] = {grid.geometry.origin_x, grid.geometry.origin_y};
  json["path"] = nlohmann::json::array();
  for (const Pose2& p : outcome.path) json["path"].push_back({p.x, p.y, p.yaw});
  json["footprint"] = nlohmann::json::array();
  for (const auto& p : trident::nav::footprint_corners(footprint, {})) {
    json["footprint"].push_back({p.x, p.y});
  }
  return json;
}

trident::nav::ControlSetup control_setup(const Arguments& arguments, double speed,
                                         const trident::nav::Footprint& footprint) {
  trident::nav::ControlSetup setup;
  const double radius_m = std::atof(arguments.options.at("turning-radius").c_str());
  setup.limits = {speed, -0.5 * speed, 0.0, 1.5, 1.0, 1.0, 1.0, 3.0, radius_m};
  setup.footprint = footprint;
  return setup;
}

/// What a controller weighs for its first command along a path.
nlohmann::json weighed(const Arguments& arguments, const Costmap& costmap,
                       const trident::nav::Path& path) {
  const double speed = std::atof(arguments.options.at("speed").c_str());
  const auto controller = trident::nav::make_controller(
      arguments.options.at("controller"), control_setup(arguments, speed, costmap.footprint()),
      trident::parse_yaml(arguments.options.at("controller-params"), "--controller-params"),
      "--controller-params");
  controller->set_watched({true, false});
  trident::nav::RobotState state;
  state.pose = arguments.start;
  state.twist.vx = speed;
  const auto outcome = controller->command(state, path, costmap.grid(), {});
  const trident::nav::ControlDetails details = controller->details();
  nlohmann::json json;
  json["reason"] = outcome.reason;
  json["selected"] = details.selected ? static_cast<int>(*details.selected) : -1;
  json["trajectories"] = nlohmann::json::array();
  for (const auto& trajectory : details.trajectories) {
    nlohmann::json points = nlohmann::json::array();
    for (const auto& point : trajectory.points) points.push_back({point.pose.x, point.pose.y});
    json["trajectories"].push_back({{"cost", trajectory.cost}, {"points", points}});
  }
  return json;
}

int run(const Arguments& arguments) {
  const std::string name = trident::nav::planner_name(arguments.options.at("planner"));
  const auto planner = trident::nav::builtin_planners().get(name)(
      trident::parse_yaml(arguments.options.at("params"), "--params"), "--params");
  const Costmap costmap = make_costmap(arguments);
  const CostGrid grid = costmap.grid();
  if (!arguments.options.at("grid").empty()) write_grid(grid, arguments.options.at("grid"));
  trident::nav::MotionLimits limits;
  limits.min_turning_radius = std::atof(arguments.options.at("turning-radius").c_str());
  const trident::nav::CancelFlag cancel{false};
  const auto before = std::chrono::steady_clock::now();
  const PlanOutcome outcome =
      planner->plan(grid, costmap.footprint(), arguments.start, arguments.goal, limits, cancel);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - before;
  nlohmann::json json = to_json(outcome, grid, costmap.footprint(), time.count());
  if (!arguments.options.at("controller").empty() && !outcome.path.empty()) {
    json["control"] = weighed(arguments, costmap, outcome.path);
  }
  std::cout << json << "\n";
  return outcome.failure == trident::nav::Failure::kNone ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(parse_arguments(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << "nav_plan: " << error.what() << "\n";
    return 2;
  }
}
