// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "ray_bundle.h"

#include <algorithm>
#include <cmath>

#include "core/plugins/plugin_util.h"

namespace trident::sim {
namespace {

double lower_rate(double sensor_hz, double plugin_hz) {
  // A rate of 0 means every step, which is the fastest and not the lowest.
  if (sensor_hz <= 0.0) return plugin_hz;
  return plugin_hz > 0.0 ? std::min(sensor_hz, plugin_hz) : sensor_hz;
}

}  // namespace

RayBundle::RayBundle(const PluginContext& context, WaterReturns water)
    : link_((required_ray_sensor(context), *context.link)),
      T_link_sensor_(context.sensor->T_link_sensor),
      spec_(read_lidar_spec(*context.sensor, context.params.owner())),
      clock_(lower_rate(context.sensor->update_rate_hz,
                        context.params.number("updateRate", 0.0, {0.0, 1e6}))),
      caster_(context, spec_.range_min_m, spec_.range_max_m, water) {
  for (int ring = 0; ring < spec_.vertical.beams; ++ring) {
    const double elevation = spec_.vertical.angle_rad(ring), level = std::cos(elevation);
    for (int beam = 0; beam < spec_.horizontal.beams; ++beam) {
      const double azimuth = spec_.horizontal.angle_rad(beam);
      directions_.emplace_back(level * std::cos(azimuth), level * std::sin(azimuth),
                               std::sin(elevation));
    }
  }
}

void RayBundle::cast(std::uint64_t scan) {
  scan_ = scan;
  const SE3 T_world_sensor = link_.T_world_link() * T_link_sensor_;
  const Eigen::Matrix3d R = T_world_sensor.R.toRotationMatrix();
  caster_.begin(directions_.size());
  for (std::size_t beam = 0; beam < directions_.size(); ++beam) {
    caster_.aim(beam, T_world_sensor.p, R * directions_[beam]);
  }
  caster_.refresh_for_aimed(T_world_sensor.p);
  caster_.cast();
}

std::string sensor_topic(const PluginParams& params, const std::string& fallback) {
  std::string topic = scoped_topic(params, params.text("topicName", fallback));
  if (params.text("topicName", fallback).find_first_not_of('/') == std::string::npos) {
    params.refuse("topicName", params.text("topicName", ""), "the name of a topic");
  }
  return topic;
}

}  // namespace trident::sim
