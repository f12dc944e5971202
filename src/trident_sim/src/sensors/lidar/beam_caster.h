// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "sea_rays/water_surface.h"
#include "trident_base/error.h"
#include "trident_sim/ray_scene.h"
#include "trident_sim/world.h"
#include "water_returns.h"

namespace trident::sim {

/// `ray` sensors hit collisions, `gpu_ray` and `gpu_lidar` sensors visuals.
inline RayGeometry geometry_of(const SensorSpec& sensor) {
  return sensor.type.rfind("gpu", 0) == 0 ? RayGeometry::kVisual : RayGeometry::kCollision;
}

/// Beams and what they hit, in memory that is kept from cast to cast.
struct BeamBatch {
  std::vector<Ray> rays;
  std::vector<RayHit> hits;
};

/// Casts the beams of a sensor. They begin at the smallest range: what is nearer is not seen.
class BeamCaster {
 public:
  /// `context` is the sensor's plugin's.
  BeamCaster(const PluginContext& context, double range_min_m, double range_max_m,
             WaterReturns water = WaterReturns::kAuto)
      : scene_(rays(context.world, geometry_of(*context.sensor))),
        sight_(read_water_returns(context.params, water), context.world.seed(), context.name) {
    blank_.t_min_m = range_min_m;
    blank_.t_max_m = range_max_m;
  }
  RayScene& scene() const { return scene_; }

  /// Room for so many beams, which are then aimed one by one.
  void begin(std::size_t beams) { begin(beams, own_); }
  void aim(std::size_t beam, const Eigen::Vector3d& p_world_origin,
           const Eigen::Vector3d& direction_world) {
    aim(beam, p_world_origin, direction_world, own_);
  }
  /// As refresh(), for what is aimed already: without the sea where no beam gets down to it.
  void refresh_for_aimed(const Eigen::Vector3d& p_world_sensor) {
    scene_.refresh();
    water_.reset();
    if (reaches(scene_.surface_ceiling_m())) refresh_water(p_world_sensor);
  }
  /// Has what is cast from now on see the sea as it is now about the sensor, in the scene as it was
  /// refreshed last.
  void refresh_water(const Eigen::Vector3d& p_world_sensor) {
    water_ = as_water(scene_.refresh_surface(p_world_sensor));
  }
  void cast() { cast(own_); }
  /// What the sensor notices of what a beam hit, or of the water before that; `scan` and `channel`
  /// are for random numbers.
  RayHit hit(std::size_t beam, std::uint64_t scan, std::uint32_t channel) const {
    return hit(own_, beam, scan, channel);
  }
  double intensity(const RayHit& hit) const { return scene_.intensity(hit); }

  // The same with a batch of the caller's. Several threads may do so at a time, each with its own.

  void begin(std::size_t beams, BeamBatch& batch) const {
    batch.rays.resize(beams);
    batch.hits.resize(beams);
  }
  void aim(std::size_t beam, const Eigen::Vector3d& p_world_origin,
           const Eigen::Vector3d& direction_world, BeamBatch& batch) const {
    batch.rays[beam] = {p_world_origin, direction_world, blank_.t_min_m, blank_.t_max_m};
  }
  void cast(BeamBatch& batch) const {
    scene_.cast({batch.rays.data(), batch.rays.size()}, {batch.hits.data(), batch.hits.size()},
                nullptr);
  }
  RayHit hit(const BeamBatch& batch, std::size_t beam, std::uint64_t scan,
             std::uint32_t channel) const {
    const Ray& ray = batch.rays[beam];
    const RayHit& hit = batch.hits[beam];
    return water_ == nullptr ? hit : sight_.see(scene_, *water_, ray, hit, scan, channel);
  }

 private:
  /// Whether a beam gets down to a height; minus infinity: there is nothing to reach.
  bool reaches(double height_m) const {
    if (height_m == -std::numeric_limits<double>::infinity()) return false;
    return std::any_of(own_.rays.begin(), own_.rays.end(), [&](const Ray& ray) {
      const double sinking = std::min(ray.direction_world.z(), 0.0);
      return !(ray.p_world_origin.z() + ray.t_max_m * sinking > height_m);
    });
  }

  RayScene& scene_;
  WaterSight sight_;
  std::shared_ptr<const WaterSurface> water_;
  Ray blank_;
  BeamBatch own_;
};

/// Throws Error when the plugin does not sit in a sensor.
inline const SensorSpec& required_ray_sensor(const PluginContext& context) {
  if (context.sensor == nullptr) {
    throw Error(context.params.owner() + ": belongs in a <sensor> of type ray or gpu_ray");
  }
  return *context.sensor;
}

}  // namespace trident::sim
