// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0

// CPU time of whole updates of Amcl (motion, weighing, estimate, resampling every time) and of the
// search of a scan in a whole map, in a building of rooms that is made here. Prints JSON.
//   amcl_benchmark [UPDATES]

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "trident_base/angle.h"
#include "trident_estimation/amcl.h"

namespace trident::estimation {
namespace {

constexpr int kSide = 800;  // 40 m x 40 m
constexpr int kBeams = 60;

/// Rooms of 5 m x 5 m with doors at places that differ, and a cabinet in each.
OccupancyGrid building() {
  OccupancyGrid grid;
  grid.width = grid.height = kSide;
  grid.cells.assign(static_cast<std::size_t>(kSide) * kSide, OccupancyGrid::kFree);
  const auto wall = [&grid](int column, int row) {
    grid.cells[grid.index(std::min(column, kSide - 1), std::min(row, kSide - 1))] =
        OccupancyGrid::kOccupied;
  };
  for (int line = 0; line <= kSide; line += 100) {
    for (int i = 0; i < kSide; ++i) {
      const int room = i / 100, door = 20 + (room * 7 + line / 100 * 13) % 50;
      const bool is_door = line > 0 && line < kSide && i % 100 >= door && i % 100 < door + 20;
      if (is_door) continue;
      wall(i, line);
      wall(line, i);
    }
  }
  for (int room = 0; room < 64; ++room) {
    const int left = room % 8 * 100 + 10 + room * 11 % 60,
              low = room / 8 * 100 + 15 + room * 5 % 60;
    for (int i = 0; i < 20 * 12; ++i) wall(left + i % 20, low + i / 20);
  }
  return grid;
}

LaserScan scan_at(const maps::DistanceField& field, const SE2& T_grid_base) {
  LaserScan scan;
  scan.angle_min = -kPi;
  scan.angle_increment = 2.0 * kPi / kBeams;
  scan.range_min = 0.1;
  scan.range_max = 12.0;
  for (int i = 0; i < kBeams; ++i) {
    const double angle = T_grid_base.angle + scan.angle(static_cast<std::size_t>(i));
    scan.ranges.push_back(static_cast<float>(field.ray(T_grid_base.p, angle, 11.9)));
  }
  return scan;
}

double cpu_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

SE2 place(int step) {  // along a corridor of doors, and to and fro in heading
  return SE2::from_xy_yaw(2.5 + 0.002 * (step % 800), 4.0, 0.3 * std::sin(0.01 * step));
}

/// Median CPU time of an update over ten blocks [ms].
double update_ms(const OccupancyGrid& map, const maps::DistanceField& field, AmclParams params,
                 int updates) {
  params.laser.laser_max_beams = kBeams;
  params.resample_interval = 1;
  params.update_min_d = params.update_min_a = 0.0;
  Amcl amcl(params, map);
  amcl.set_pose(place(0), Eigen::Vector3d(0.01, 0.01, 0.01).asDiagonal());
  std::vector<LaserScan> scans;
  for (int i = 0; i < 100; ++i) scans.push_back(scan_at(field, place(i)));
  std::vector<double> blocks;
  for (int block = 0; block < 10; ++block) {
    const double begin = cpu_s();
    for (int i = 0; i < updates; ++i) {
      const int at = i % 200 < 100 ? i % 200 : 199 - i % 200;
      amcl.force_update();
      amcl.update(scans[static_cast<std::size_t>(at)], place(at));
    }
    blocks.push_back(1e3 * (cpu_s() - begin) / updates);
  }
  std::nth_element(blocks.begin(), blocks.begin() + 5, blocks.end());
  return blocks[5];
}

double match_ms(const OccupancyGrid& map, const maps::DistanceField& field) {
  const maps::GridMatcher matcher(map);
  const double begin = cpu_s();
  constexpr int kTimes = 10;
  for (int i = 0; i < kTimes; ++i) {
    const SE2 T_grid_base = SE2::from_xy_yaw(2.5 + 3.7 * i, 37.0 - 3.3 * i, 0.6 * i);
    matcher.match(select_beams(scan_at(field, T_grid_base), LaserModelParams{}).points);
  }
  return 1e3 * (cpu_s() - begin) / kTimes;
}

int run(int updates) {
  const OccupancyGrid map = building();
  const maps::DistanceField field(map, 2.0);
  AmclParams params;
  params.min_particles = params.max_particles = 2000;
  const double likelihood_field = update_ms(map, field, params, updates);
  params.laser.laser_model_type = LaserModel::kLikelihoodFieldProb;
  const double prob = update_ms(map, field, params, updates);
  params.laser.laser_model_type = LaserModel::kBeam;
  const double beam = update_ms(map, field, params, std::max(1, updates / 20));
  params.laser.laser_model_type = LaserModel::kLikelihoodField;
  params.min_particles = params.max_particles = 5000;
  const double many = update_ms(map, field, params, std::max(1, updates / 2));
  std::printf(
      "{\"particles\": 2000, \"beams\": %d, \"likelihood_field_ms\": %.4f, "
      "\"likelihood_field_prob_ms\": %.4f, \"beam_ms\": %.4f, "
      "\"likelihood_field_5000_ms\": %.4f, \"match_whole_map_ms\": %.2f}\n",
      kBeams, likelihood_field, prob, beam, many, match_ms(map, field));
  return 0;
}

}  // namespace
}  // namespace trident::estimation

int main(int argc, char** argv) {
  return trident::estimation::run(argc > 1 ? std::max(1, std::atoi(argv[1])) : 200);
}
