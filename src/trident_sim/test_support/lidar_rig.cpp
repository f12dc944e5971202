// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "lidar_rig.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace trident::sim {
namespace {

ParamNode text_node(const std::string& name, const std::string& text) {
  return {name, text, {}, {}};
}
ParamNode number_node(const std::string& name, double value) {
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text_node(name, text.str());
}
ParamNode fan_node(const std::string& name, int beams, double min_rad, double max_rad) {
  return {name,
          "",
          {},
          {text_node("samples", std::to_string(beams)), number_node("min_angle", min_rad),
           number_node("max_angle", max_rad)}};
}

}  // namespace

SensorSpec make_lidar(const LidarOptions& options) {
  SensorSpec sensor;
  sensor.name = "laser";
  sensor.type = options.type;
  sensor.update_rate_hz = options.rate_hz;
  sensor.T_link_sensor = options.T_link_sensor;
  const ParamNode range{
      "range",
      "",
      {},
      {number_node("min", options.range_min_m), number_node("max", options.range_max_m)}};
  const ParamNode noise{
      "noise", "", {}, {text_node("type", "gaussian"), number_node("stddev", options.stddev_m)}};
  const ParamNode scan{
      "scan",
      "",
      {},
      {fan_node("horizontal", options.beams, options.min_rad, options.max_rad),
       fan_node("vertical", options.rings, options.lowest_rad, options.highest_rad)}};
  sensor.params = {"sensor", "", {}, {{"ray", "", {}, {scan, range, noise}}}};
  ParamList params = options.params;
  params.insert(params.begin(), {{"robotNamespace", "r"}, {"topicName", "scan"}});
  sensor.plugins.push_back(make_plugin("p", options.file, params));
  return sensor;
}

ModelSpec robot_with(const LidarOptions& options, const SE3& T_world_model) {
  ModelSpec model = make_body("robot", SphereShape{0.05}, T_world_model);
  model.links[0].gravity = false;
  model.links[0].sensors.push_back(make_lidar(options));
  return model;
}

void add_walls(TestWorld& world, double half_m, double height_m) {
  const double thick = 0.2, center = half_m + thick / 2.0, length = 2.0 * half_m + 2.0 * thick;
  world.add(make_static("east", BoxShape{{thick, length, height_m}}, at(center, 0, 0)));
  world.add(make_static("west", BoxShape{{thick, length, height_m}}, at(-center, 0, 0)));
  world.add(make_static("north", BoxShape{{length, thick, height_m}}, at(0, center, 0)));
  world.add(make_static("south", BoxShape{{length, thick, height_m}}, at(0, -center, 0)));
}

double wall_range(double half_m, double angle) {
  return half_m / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
}

}  // namespace trident::sim
