// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// Rays cast per second of CPU time on one core in a world of 60 boxes on a ground plane, as JSON:
// a 360-beam fan, a 16 x 1800 pattern like a VLP-16's, the same with moving boxes and with one body
// excluded, and shadow rays.
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include "box_world.h"
#include "trident_base/angle.h"
#include "trident_sim/ray_scene.h"
#include "trident_sim/world.h"

namespace trident::sim {
namespace {

constexpr double kMinCpuSeconds = 0.5;  ///< per figure

Ray make_ray(double azimuth, double elevation, double t_max_m) {
  const double level = std::cos(elevation);
  return {{0.0, 0.0, 0.5},
          {level * std::cos(azimuth), level * std::sin(azimuth), std::sin(elevation)},
          0.1,
          t_max_m};
}

std::vector<Ray> make_fan() {
  std::vector<Ray> rays;
  rays.reserve(360);
  for (int i = 0; i < 360; ++i) rays.push_back(make_ray(2.0 * kPi * i / 360.0, 0.0, 30.0));
  return rays;
}

/// 16 rings from -15 to 15 degrees, in the order in which such a sensor fires: column by column.
std::vector<Ray> make_rings() {
  std::vector<Ray> rays;
  rays.reserve(1800 * 16);
  for (int column = 0; column < 1800; ++column) {
    for (int ring = 0; ring < 16; ++ring) {
      rays.push_back(
          make_ray(2.0 * kPi * column / 1800.0, (2.0 * ring - 15.0) * kPi / 180.0, 100.0));
    }
  }
  return rays;
}

struct Rate {
  double mrays_per_s = 0.0;
  double hit_share = 0.0;
};

template <class Call>
Rate measure(std::size_t rays, Call&& call) {
  std::size_t hit_count = call();
  std::uint64_t rounds = 0;
  const double begin = thread_cpu_s();
  double spent_s = 0.0;
  while (spent_s < kMinCpuSeconds) {
    for (int i = 0; i < 10; ++i) hit_count = call();
    rounds += 10;
    spent_s = thread_cpu_s() - begin;
  }
  return {static_cast<double>(rounds * rays) / spent_s / 1e6,
          static_cast<double>(hit_count) / static_cast<double>(rays)};
}

Rate measure_cast(const RayScene& scene, const std::vector<Ray>& rays, const RayFilter& filter) {
  std::vector<RayHit> hits(rays.size());
  return measure(rays.size(), [&] {
    scene.cast(rays, hits, filter);
    std::size_t hit_count = 0;
    for (const RayHit& hit : hits) hit_count += hit.is_hit() ? 1 : 0;
    return hit_count;
  });
}

/// Shadow rays: from what the rays hit to a lamp.
Rate measure_shadows(const RayScene& scene, const std::vector<Ray>& rays) {
  const Eigen::Vector3d lamp(3.0, 4.0, 10.0);
  std::vector<RayHit> hits(rays.size());
  scene.cast(rays, hits);
  std::vector<Ray> to_lamp;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i].is_hit()) continue;
    const Eigen::Vector3d p = rays[i].p_world_origin + hits[i].distance_m * rays[i].direction_world;
    const double distance = (lamp - p).norm();
    to_lamp.push_back({p, (lamp - p) / distance, 1e-3, distance});
  }
  const std::unique_ptr<bool[]> dark(new bool[to_lamp.size()]);
  return measure(to_lamp.size(), [&] {
    scene.occluded(to_lamp, {dark.get(), to_lamp.size()});
    std::size_t hit_count = 0;
    for (std::size_t i = 0; i < to_lamp.size(); ++i) hit_count += dark[i] ? 1 : 0;
    return hit_count;
  });
}

void print(const char* name, const Rate& rate) {
  std::printf("\"%s\": {\"mrays_per_s_core\": %.2f, \"met_share\": %.3f}, ", name, rate.mrays_per_s,
              rate.hit_share);
}

double refresh_us(World& world, RayScene& scene, bool moving) {
  constexpr int kRounds = 200;
  double spent_s = 0.0;
  for (int i = 0; i < kRounds; ++i) {
    if (moving) world.step();
    const double begin = thread_cpu_s();
    scene.refresh();
    spent_s += thread_cpu_s() - begin;
  }
  return 1e6 * spent_s / kRounds;
}

int run() {
  PluginRegistry registry;
  World fixed_world(WorldSpec{}, Resources(), registry, {});
  World moving_world(WorldSpec{}, Resources(), registry, {});
  for (World* world : {&fixed_world, &moving_world}) {
    add_boxes(*world, world == &fixed_world);
  }
  RayScene& fixed = sim::rays(fixed_world, RayGeometry::kCollision);
  RayScene& moving = sim::rays(moving_world, RayGeometry::kCollision);
  fixed.refresh();
  moving.refresh();
  const std::vector<Ray> fan = make_fan(), rings = make_rings();
  RayFilter own_body;
  own_body.exclude_model = fixed_world.find_model("box0");
  std::printf("{\"world\": \"60 boxes, ground plane\", \"measured\": \"thread CPU time\", ");
  print("fan_360", measure_cast(fixed, fan, {}));
  print("rings_16x1800", measure_cast(fixed, rings, {}));
  print("rings_16x1800_excluding", measure_cast(fixed, rings, own_body));
  print("fan_360_moving", measure_cast(moving, fan, {}));
  print("rings_16x1800_moving", measure_cast(moving, rings, {}));
  print("shadows", measure_shadows(fixed, rings));
  print("shadows_moving", measure_shadows(moving, rings));
  std::printf("\"refresh_us_60_moved\": %.1f, \"refresh_us_nothing_moved\": %.2f}\n",
              refresh_us(moving_world, moving, true), refresh_us(moving_world, moving, false));
  return 0;
}

}  // namespace
}  // namespace trident::sim

int main() { return trident::sim::run(); }
