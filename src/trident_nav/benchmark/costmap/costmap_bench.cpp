// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Measures how long updates of costmaps take: a line of JSON per case with its name, the median,
/// the mean and the 99th percentile of this thread's CPU time [ms].
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "trident_base/random_stream.h"
#include "trident_nav/costmap/beam_layer.h"
#include "trident_nav/costmap/costmap.h"
#include "trident_nav/costmap/layer_factory.h"
#include "trident_nav/costmap/static_layer.h"

namespace trident::nav {
namespace {

double cpu_ms() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

/// Calls `prepare(i)` and `run()` so many times and prints what `run` took.
void measure(const std::string& name, int rounds, const std::function<void(int)>& prepare,
             const std::function<void()>& run) {
  std::vector<double> times;
  for (int i = 0; i < rounds; ++i) {
    prepare(i);
    const double begin = cpu_ms();
    run();
    times.push_back(cpu_ms() - begin);
  }
  std::sort(times.begin(), times.end());
  const std::size_t n = times.size();
  const double sum = std::accumulate(times.begin(), times.end(), 0.0);
  std::printf(
      "{\"name\": \"%s\", \"median_cpu_ms\": %.3f, \"mean_cpu_ms\": %.3f, \"p99_cpu_ms\": "
      "%.3f}\n",
      name.c_str(), times[n / 2], sum / static_cast<double>(n), times[n * 99 / 100]);
  std::fflush(stdout);
}

std::unique_ptr<Layer> layer(const std::string& type, const std::string& yaml) {
  static const auto* registry = [] {
    auto* result = new Registry<LayerType>("layer");
    register_builtin_layers(*result);
    return result;
  }();
  LayerSetup setup;
  setup.name = type;
  setup.config = parse_yaml(yaml, "bench");
  return make_layer(*registry, type, setup);
}

const char* const kInflation = "{inflation_radius: 0.55, cost_scaling_factor: 10.0}";

/// Rooms of 4 to 12 m with walls, doors and furniture, as a map of a building.
OccupancyGrid building(int size, std::uint64_t seed) {
  OccupancyGrid map;
  map.width = map.height = size;
  map.cells.assign(map.index(0, size), OccupancyGrid::kFree);
  const RandomStream random(seed, "building");
  std::uint64_t next = 0;
  const auto draw = [&](int low, int high) {
    return low + static_cast<int>(random.uniform(next++, 0) * (high - low));
  };
  const auto fill = [&](int x0, int y0, int x1, int y1, std::int8_t value) {
    for (int y = std::max(y0, 0); y < std::min(y1, size); ++y) {
      for (int x = std::max(x0, 0); x < std::min(x1, size); ++x) map.cells[map.index(x, y)] = value;
    }
  };
  for (int y = 0; y < size; y += draw(80, 240)) {
    fill(0, y, size, y + 3, 100);
    for (int x = draw(20, 100); x < size; x += draw(80, 240)) fill(x, y, x + 20, y + 3, 0);
  }
  for (int x = 0; x < size; x += draw(80, 240)) {
    for (int y = 0; y < size; y += 200) fill(x, y, x + 3, y + 170, 100);
  }
  for (int k = 0; k < size * size / 4000; ++k) {
    const int x = draw(0, size), y = draw(0, size);
    fill(x, y, x + draw(2, 10), y + draw(2, 10), 100);
  }
  return map;
}

/// A scan of so many beams from the middle of a star-shaped room whose walls sway.
Observation star_scan(const Eigen::Vector3d& origin, int beams, double range_m, double phase,
                      double stamp_s) {
  Observation result;
  result.stamp_s = stamp_s;
  result.groups.push_back({origin, 0, static_cast<std::size_t>(beams)});
  for (int i = 0; i < beams; ++i) {
    const double angle = 2.0 * M_PI * i / beams;
    const double range = range_m * (0.7 + 0.2 * std::sin(5 * angle) + 0.1 * std::sin(phase));
    result.ends.push_back(
        {Eigen::Vector3d(range * std::cos(angle), range * std::sin(angle), 0.0).cast<float>(),
         true});
  }
  return result;
}

void large_map(int rounds) {
  std::vector<std::unique_ptr<Layer>> layers;
  layers.push_back(layer("StaticLayer", ""));
  layers.push_back(layer("ObstacleLayer",
                         "{sources: {scan: {clearing: true, obstacle_range: 8, "
                         "raytrace_range: 10}}}"));
  layers.push_back(layer("InflationLayer", kInflation));
  auto* map_layer = dynamic_cast<StaticLayer*>(layers[0].get());
  auto* beams = dynamic_cast<BeamLayer*>(layers[1].get());
  Costmap costmap(CostmapParams{}, std::move(layers));
  const OccupancyGrid maps[] = {building(4000, 1), building(4000, 2)};
  const CostmapInput input{0.0, {100.0, 100.0, 0.0}};
  measure(
      "4000x4000 another map", rounds, [&](int i) { map_layer->set_map(maps[i % 2]); },
      [&] { costmap.update(input); });
  measure(
      "4000x4000 take in a map", rounds, [](int) {},
      [&, i = 0]() mutable { map_layer->set_map(maps[i++ % 2]); });
  costmap.update(input);
  measure(
      "4000x4000 all again", rounds,
      [&](int i) { costmap.layer("ObstacleLayer")->set_enabled(i % 2 == 0); },
      [&] { costmap.update(input); });
  costmap.layer("ObstacleLayer")->set_enabled(true);
  costmap.update(input);
  measure(
      "4000x4000 one scan", 20 * rounds,
      [&](int i) {
        beams->sources()[0].add(
            star_scan({100.0 + 0.002 * i, 100.0, 0.2}, 720, 6.0, 0.05 * i, 0.1 * i));
      },
      [&] { costmap.update(input); });
}

void window(const std::string& name, double size_m, int beams_count, double range_m,
            const std::string& type, const std::string& ranges, int rounds) {
  std::vector<std::unique_ptr<Layer>> layers;
  layers.push_back(layer(type, "{sources: {scan: {clearing: true, " + ranges + "}}}"));
  layers.push_back(layer("InflationLayer", kInflation));
  auto* beams = dynamic_cast<BeamLayer*>(layers[0].get());
  CostmapParams params;
  params.rolling_window = true;
  params.width = params.height = size_m;
  Costmap costmap(params, std::move(layers));
  CostmapInput input;
  measure(
      name, rounds,
      [&](int i) {
        input.now_s = 0.05 * i;
        input.robot.x = 0.5 * input.now_s;
        beams->sources()[0].add(
            star_scan({input.robot.x, 0.0, 0.2}, beams_count, range_m, input.now_s, input.now_s));
      },
      [&] { costmap.update(input); });
}

/// A turn of 16 rings of 1800 points, of +-15 degrees, in a room with walls 3 m high.
Observation ring_scan(const Eigen::Vector3d& origin, double phase, double stamp_s) {
  Observation result;
  result.stamp_s = stamp_s;
  result.groups.push_back({origin, 0, 28800});
  for (int i = 0; i < 28800; ++i) {
    const double angle = 2.0 * M_PI * (i / 16) / 1800,
                 rise = std::tan(M_PI / 180 * (i % 16 * 2 - 15));
    const double wall = 5.0 + 2.0 * std::sin(5 * angle) + 0.5 * std::sin(phase);
    const double floor = rise < 0.0 ? origin.z() / -rise : 1e9;
    const double range = std::min(wall, floor);
    const Eigen::Vector3d p(range * std::cos(angle), range * std::sin(angle), range * rise);
    result.ends.push_back({p.cast<float>(), true});
  }
  return result;
}

void voxels(int rounds) {
  std::vector<std::unique_ptr<Layer>> layers;
  layers.push_back(layer("VoxelLayer",
                         "{z_voxels: 16, z_resolution: 0.125, sources: {cloud: {clearing: true, "
                         "min_obstacle_height: 0.1}}}"));
  layers.push_back(layer("InflationLayer", kInflation));
  auto* beams = dynamic_cast<BeamLayer*>(layers[0].get());
  CostmapParams params;
  params.rolling_window = true;
  Costmap costmap(params, std::move(layers));
  CostmapInput input;
  measure(
      "28800 points, 16 levels", rounds,
      [&](int i) {
        input.now_s = 0.1 * i;
        input.robot.x = 0.05 * i;
        beams->sources()[0].add(ring_scan({input.robot.x, 0.0, 0.6}, 0.1 * i, input.now_s));
      },
      [&] { costmap.update(input); });
}

}  // namespace
}  // namespace trident::nav

int main() {
  using namespace trident::nav;
  window("6x6 m window, 360 beams", 6.0, 360, 3.5, "ObstacleLayer",
         "obstacle_range: 2.5, raytrace_range: 3.0", 400);
  window("10x10 m window, 720 beams", 10.0, 720, 6.0, "ObstacleLayer",
         "obstacle_range: 5.0, raytrace_range: 7.0", 400);
  voxels(200);
  large_map(20);
  return 0;
}
