// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "trident_base/error.h"
#include "trident_sim/ray_scene.h"
#include "trident_sim/world.h"
#include "water_returns.h"

namespace trident {

/// `ray` sensors meet collisions, `gpu_ray` and `gpu_lidar` sensors visuals.
inline RayGeometry geometry_of(const SensorSpec& sensor) {
  return sensor.type.rfind("gpu", 0) == 0 ? RayGeometry::kVisual : RayGeometry::kCollision;
}

/// The rays of a sensor's beams and what they met, in memory that is kept from cast to cast. Beams
/// begin at the smallest range: what is nearer is not seen.
class BeamCaster {
 public:
  /// `context` is the sensor's plugin's.
  BeamCaster(const PluginContext& context, double range_min_m, double range_max_m,
             WaterReturns water = WaterReturns::kAuto)
      : scene_(context.world.rays(geometry_of(*context.sensor))),
        water_(scene_, read_water_returns(context.params, water), context.world.seed(),
               context.name) {
    blank_.t_min_m = range_min_m;
    blank_.t_max_m = range_max_m;
  }

  /// Room for so many beams, which are then aimed one by one.
  void begin(std::size_t beams) {
    rays_.resize(beams, blank_);
    hits_.resize(beams);
  }
  void aim(std::size_t beam, const Eigen::Vector3d& p_world_origin,
           const Eigen::Vector3d& direction_world) {
    rays_[beam].p_world_origin = p_world_origin;
    rays_[beam].direction_world = direction_world;
  }
  /// As refresh(), for what is aimed already: without the sea where no beam gets down to it.
  void refresh_for_aimed(const Eigen::Vector3d& p_world_sensor) {
    scene_.refresh();
    if (reaches(scene_.water_ceiling_m())) scene_.refresh_water(p_world_sensor);
    sees_water_ = scene_.water() != nullptr;
  }
  /// Has what is cast from now on see the world as it is now, and the sea about the sensor.
  void refresh(const Eigen::Vector3d& p_world_sensor) {
    scene_.refresh();
    scene_.refresh_water(p_world_sensor);
    sees_water_ = scene_.water() != nullptr;
  }
  void cast() { cast(0, rays_.size()); }
  /// Beams [first, first + count) alone; several threads may do so at a time.
  void cast(std::size_t first, std::size_t count) {
    scene_.cast({rays_.data() + first, count}, {hits_.data() + first, count});
  }
  /// What the sensor notices of what a beam met; `scan` and `channel` are for random numbers.
  const RayHit& hit(std::size_t beam, std::uint64_t scan, std::uint32_t channel) const {
    if (!sees_water_ || water_.tells(rays_[beam], hits_[beam], scan, channel)) return hits_[beam];
    static const RayHit nothing;
    return nothing;
  }
  double intensity(const RayHit& hit) const { return scene_.intensity(hit); }

 private:
  /// Whether a beam gets down to a height; minus infinity: there is nothing to reach.
  bool reaches(double height_m) const {
    if (height_m == -std::numeric_limits<double>::infinity()) return false;
    return std::any_of(rays_.begin(), rays_.end(), [&](const Ray& ray) {
      const double sinking = std::min(ray.direction_world.z(), 0.0);
      return !(ray.p_world_origin.z() + ray.t_max_m * sinking > height_m);
    });
  }

  RayScene& scene_;
  WaterSight water_;
  bool sees_water_ = false;
  Ray blank_;
  std::vector<Ray> rays_;
  std::vector<RayHit> hits_;
};

/// Throws Error when the plugin does not sit in a sensor.
inline const SensorSpec& required_ray_sensor(const PluginContext& context) {
  if (context.sensor == nullptr) {
    throw Error(context.params.owner() + ": belongs in a <sensor> of type ray or gpu_ray");
  }
  return *context.sensor;
}

}  // namespace trident
