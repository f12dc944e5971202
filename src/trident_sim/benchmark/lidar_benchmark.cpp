// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// What lidars cost on one core, as JSON: the CPU time of a world that is stepped while their topics
// are listened to, less that of the same world while nobody listens. Robots turn as they glide
// through sixty boxes, so that the scene must follow them in every step; ranges are noisy. Rows
// that begin with sea_ are of the same lidars over waves of 0.3 m and nothing else.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "box_world.h"
#include "trident_base/angle.h"

namespace trident::sim {
namespace {

using Texts = std::vector<std::pair<std::string, std::string>>;

ParamNode element(const std::string& name, const Texts& texts) {
  ParamNode node;
  node.name = name;
  for (const auto& [key, text] : texts) node.children.push_back({key, text, {}, {}});
  return node;
}

struct Lidar {
  const char* name;
  const char* plugin;
  int columns, rings;
  double elevation_rad, rate_hz, range_m;
  Texts params;
};

SensorSpec make_sensor(const Lidar& lidar) {
  const std::string last = std::to_string(2.0 * kPi * (lidar.columns - 1) / lidar.columns);
  ParamNode scan;
  scan.name = "scan";
  scan.children = {element("horizontal", {{"samples", std::to_string(lidar.columns)},
                                          {"min_angle", "0"},
                                          {"max_angle", last}}),
                   element("vertical", {{"samples", std::to_string(lidar.rings)},
                                        {"min_angle", std::to_string(-lidar.elevation_rad)},
                                        {"max_angle", std::to_string(lidar.elevation_rad)}})};
  ParamNode ray;
  ray.name = "ray";
  ray.children = {scan, element("range", {{"min", "0.5"}, {"max", std::to_string(lidar.range_m)}}),
                  element("noise", {{"type", "gaussian"}, {"stddev", "0.01"}})};
  SensorSpec sensor;
  sensor.name = "lidar";
  sensor.type = "ray";
  sensor.update_rate_hz = lidar.rate_hz;
  sensor.T_link_sensor.p.z() = 0.2;
  sensor.params.name = "sensor";
  sensor.params.children = {ray};
  sensor.plugins = {{"p", lidar.plugin, element("plugin", lidar.params)}};
  return sensor;
}

void add_robot(World& world, int number, const Lidar& lidar) {
  const std::string name = "robot" + std::to_string(number);
  SE3 T;
  T.p = {1.5 * (number % 3) - 1.5, 1.5 * (number / 3), 0.5};
  ModelSpec spec = make_model(name, SphereShape{0.1}, T, false);
  spec.links[0].gravity = false;
  spec.links[0].sensors.push_back(make_sensor(lidar));
  Model& robot = world.spawn(std::move(spec), name);
  world.set_model_twist(robot, {0.01, 0.02, 0.0}, {0.0, 0.0, 0.5});
}

struct Cost {
  double cpu_s_per_s = 0.0;  ///< of simulated time
  double scans_per_s = 0.0;  ///< of simulated time
};

double cpu_of_steps(World& world, std::uint64_t steps) {
  const double begin = thread_cpu_s();
  world.step(steps);
  return thread_cpu_s() - begin;
}

/// The waves of config/environments/sea_state_2.yaml.
PluginSpec make_sea() {
  ParamNode plugin;
  plugin.children = {element("waves", {{"spectrum", "jonswap"},
                                       {"significant_height", "0.3"},
                                       {"peak_period", "4"},
                                       {"components", "60"},
                                       {"spreading", "10"}})};
  return {"sea", "libtrident_sea.so", plugin};
}

enum class Around { kBoxes, kSea };

Cost measure(const Lidar& lidar, Around around, int robots, double dt_s, double simulated_s) {
  PluginRegistry registry;
  register_builtin_plugins(registry);
  WorldSpec spec;
  spec.physics.max_step_size_s = dt_s;
  if (around == Around::kSea) spec.plugins = {make_sea()};
  World world(spec, Resources(), registry, {});
  if (around == Around::kBoxes) add_boxes(world, true);
  for (int i = 0; i < robots; ++i) add_robot(world, i, lidar);
  const auto steps = static_cast<std::uint64_t>(simulated_s / dt_s);
  world.step(100);
  const double alone_s = cpu_of_steps(world, steps);
  std::vector<PortBase*> ports;
  for (int i = 0; i < robots; ++i) {
    const std::string name = "robot" + std::to_string(i) + "/scan";
    ports.push_back(world.ports().find(name, PortDirection::kOut));
    ports.back()->add_listener();
  }
  world.step(steps / 4);
  std::uint64_t scans = 0;
  for (const PortBase* port : ports) scans -= port->count();
  const double cast_s = cpu_of_steps(world, steps) - alone_s;
  for (const PortBase* port : ports) scans += port->count();
  return {cast_s / simulated_s, static_cast<double>(scans) / simulated_s};
}

void print(const std::string& name, const Lidar& lidar, const Cost& cost, int robots) {
  const double rays = cost.scans_per_s * lidar.columns * lidar.rings;
  std::printf(
      "\"%s\": {\"cpu_s_per_s\": %.4f, \"mrays_per_s_core\": %.2f, \"scans_per_cpu_s\": %.0f}",
      name.c_str(), cost.cpu_s_per_s / robots, rays / cost.cpu_s_per_s / 1e6,
      cost.scans_per_s / cost.cpu_s_per_s);
}

int run(double simulated_s, const std::string& only) {
  const Texts topic = {{"topicName", "scan"}};
  Texts vlp = topic;
  vlp.insert(vlp.end(), {{"beamPeriod", "2.304e-6"},
                         {"firingOrder", "0 8 1 9 2 10 3 11 4 12 5 13 6 14 7 15"}});
  const double steep = deg_to_rad(15.0), wide = deg_to_rad(22.5);
  const Lidar vlp16{"vlp16", "libtrident_lidar3d.so", 1808, 16, steep, 10.0, 100.0, vlp};
  const Lidar os1{"os1_64", "libtrident_lidar3d.so", 1024, 64, wide, 10.0, 120.0, topic};
  const Lidar snapshot{
      "velodyne_snapshot", "libgazebo_ros_velodyne_laser.so", 1875, 16, steep, 10.0, 130.0, topic};
  const Lidar planar{"scan360", "libgazebo_ros_laser.so", 360, 1, 0.0, 1000.0, 30.0, topic};
  const Lidar rolling{"scan360_rolling", "libtrident_lidar.so", 360, 1, 0.0, 10.0, 30.0, topic};
  std::printf(
      "{\"world\": \"60 boxes, ground plane\", \"measured\": \"thread CPU time, less the "
      "world's own\"");
  for (const Lidar& lidar : {vlp16, os1, snapshot, planar, rolling}) {
    for (const double dt_s : {0.001, 0.01}) {
      for (const int robots : {1, 6}) {
        const std::string name = std::string(lidar.name) + (dt_s < 0.005 ? "_1ms" : "_10ms") +
                                 "_x" + std::to_string(robots);
        if (name.find(only) == std::string::npos) continue;
        std::printf(",\n ");
        print(name, lidar, measure(lidar, Around::kBoxes, robots, dt_s, simulated_s), robots);
        std::fflush(stdout);
      }
    }
  }
  for (const Lidar& lidar : {vlp16, snapshot}) {
    const std::string name = std::string("sea_") + lidar.name + "_10ms_x1";
    if (name.find(only) == std::string::npos) continue;
    std::printf(",\n ");
    print(name, lidar, measure(lidar, Around::kSea, 1, 0.01, simulated_s), 1);
    std::fflush(stdout);
  }
  std::printf("}\n");
  return 0;
}

}  // namespace
}  // namespace trident::sim

/// Arguments: simulated seconds per figure (10), part of the names of the figures to take (all).
int main(int argc, char** argv) {
  return trident::sim::run(argc > 1 ? std::atof(argv[1]) : 10.0, argc > 2 ? argv[2] : "");
}
