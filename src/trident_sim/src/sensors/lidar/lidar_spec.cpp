// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "lidar_spec.h"

#include <algorithm>
#include <cmath>

#include "rays/ray_budget.h"
#include "trident_base/error.h"
#include "trident_sim/param_tree.h"

namespace trident::sim {
namespace {

constexpr double kMaxSamples = 1e9;
constexpr double kFarthest = 1e6;    ///< [m]
constexpr double kMaxTurned = 13.0;  ///< [rad], files round two pi up

const ParamNode& child_or_empty(const ParamNode& node, const char* name) {
  static const ParamNode empty;
  const ParamNode* const child = node.find(name);
  return child != nullptr ? *child : empty;
}

/// `<samples>` x `<resolution>`: Gazebo casts `samples` rays and interpolates between them; all are
/// cast here.
double read_beams(const ParamNode& scan, const char* name, const std::string& owner) {
  const PluginParams params(child_or_empty(scan, name), owner + " <" + name + ">");
  const int samples = params.integer("samples", 1, {1.0, kMaxSamples});
  return std::max(1.0, std::round(samples * params.number("resolution", 1.0, {1e-6, 1e3})));
}

BeamFan read_fan(const ParamNode& scan, const char* name, const std::string& owner) {
  const PluginParams params(child_or_empty(scan, name), owner + " <" + name + ">");
  BeamFan fan;
  fan.beams = static_cast<int>(read_beams(scan, name, owner));
  fan.min_rad = params.number("min_angle", 0.0, {-kMaxTurned, kMaxTurned});
  fan.max_rad = params.number("max_angle", 0.0, {-kMaxTurned, kMaxTurned});
  if (fan.beams > 1 && !(fan.max_rad >= fan.min_rad)) {
    params.refuse("max_angle", params.text("max_angle", "0"),
                  "at least <min_angle>, " + params.text("min_angle", "0"));
  }
  return fan;
}

GaussianNoise read_noise(const ParamNode& element, const std::string& owner) {
  GaussianNoise noise;
  const ParamNode* const node = element.find("noise");
  if (node == nullptr) return noise;
  const PluginParams params(*node, owner + " <noise>");
  const std::string type = params.text("type", "none");
  if (type == "none") return noise;
  if (type != "gaussian") params.refuse("type", type, "none or gaussian");
  noise.mean = params.number("mean", 0.0);
  noise.stddev = params.number("stddev", 0.0, {0.0, kFarthest});
  return noise;
}

}  // namespace

LidarSpec read_lidar_spec(const SensorSpec& sensor, const std::string& owner) {
  const ParamNode* element = sensor.params.find("ray");
  if (element == nullptr) element = sensor.params.find("lidar");
  if (element == nullptr) throw Error(owner + ": <ray> is missing");
  const ParamNode& scan = child_or_empty(*element, "scan");
  const RayCount count{read_beams(scan, "horizontal", owner), read_beams(scan, "vertical", owner),
                       "beams"};
  check_ray_count(count, sensor.params, owner);
  LidarSpec spec;
  spec.horizontal = read_fan(scan, "horizontal", owner);
  spec.vertical = read_fan(scan, "vertical", owner);
  const PluginParams range(child_or_empty(*element, "range"), owner + " <range>");
  spec.range_min_m = range.number("min", 0.0, {0.0, kFarthest});
  // "inf" is what some files say for no limit.
  spec.range_max_m = range.text("max", "").find("inf") == std::string::npos
                         ? range.number("max", kFarthest, {0.0, kFarthest})
                         : kFarthest;
  spec.range_resolution_m = range.number("resolution", 0.0, {0.0, kFarthest});
  if (!(spec.range_min_m < spec.range_max_m)) {
    range.refuse("min", range.text("min", "0"), "less than <max>, " + range.text("max", "0"));
  }
  spec.noise = read_noise(*element, owner);
  return spec;
}

}  // namespace trident::sim
