// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0

// Feeds recorded scans to Amcl, for benchmarks and tests that simulate elsewhere.
//   amcl_replay MAP.yaml PARAMETERS.yaml < RECORDS > POSES
// A record is a row of doubles in the machine's byte order:
//   0 (scan), stamp [s], odometry x y yaw, motion during the scan x y yaw, laser's place x y yaw,
//     angle_min, angle_increment, range_min, range_max, number of ranges, ranges: prints
//     "pose STAMP X Y YAW AGREEMENT PARTICLES HYPOTHESES", the pose in the map at the stamp;
//   1 (pose), x, y, yaw, variances of x, y, yaw: where the robot is believed to be;
//   2 (anywhere);
//   3 (place), x, y, yaw: prints "place RATIO", the score of the best other place of the map for a
//     scan of the map from there, as a share of the score there.

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/yaml_config.h"
#include "trident_estimation/amcl.h"
#include "trident_maps/map_file.h"

namespace trident::estimation {
namespace {

constexpr double kLidarRange = 12.0;  // of places that are judged [m]
constexpr double kElsewhere = 0.5;    // from there on a place is another one [m]

template <std::size_t N>
std::optional<std::array<double, N>> read_row() {
  std::array<double, N> row{};
  if (std::fread(row.data(), sizeof(double), N, stdin) != N) return {};
  return row;
}

class Replay {
 public:
  Replay(const OccupancyGrid& map, const AmclParams& params)
      : map_(map), field_(map, 2.0), params_(params), amcl_(params, map), matcher_(map, all()) {}

  bool scan() {
    const auto row = read_row<15>();
    if (!row) return false;
    const std::array<double, 15>& r = *row;
    LaserScan scan;
    scan.stamp_ns = static_cast<std::int64_t>(std::llround(1e9 * r[0]));
    const SE2 T_odom_base = SE2::from_xy_yaw(r[1], r[2], r[3]);
    const SE2 T_start_end = SE2::from_xy_yaw(r[4], r[5], r[6]);
    scan.T_base_laser = SE2::from_xy_yaw(r[7], r[8], r[9]);
    scan.angle_min = r[10];
    scan.angle_increment = r[11];
    scan.range_min = r[12];
    scan.range_max = r[13];
    std::vector<double> ranges(static_cast<std::size_t>(r[14]));
    if (std::fread(ranges.data(), sizeof(double), ranges.size(), stdin) != ranges.size()) {
      return false;
    }
    scan.ranges.assign(ranges.begin(), ranges.end());
    const AmclStep step = amcl_.update(scan, T_odom_base, T_start_end);
    const PoseEstimate& estimate = amcl_.estimate();
    if (step.is_updated) T_map_odom_ = estimate.T_map_base * T_odom_base.inverse();
    const SE2 T_map_base = T_map_odom_ * T_odom_base;
    std::printf("pose %.3f %.4f %.4f %.4f %.3f %zu %zu\n", r[0], T_map_base.p.x(), T_map_base.p.y(),
                T_map_base.angle, estimate.agreement, estimate.particles, step.hypotheses);
    return true;
  }

  bool pose() {
    const auto row = read_row<6>();
    if (!row) return false;
    const std::array<double, 6>& r = *row;
    amcl_.set_pose(SE2::from_xy_yaw(r[0], r[1], r[2]),
                   Eigen::Vector3d(r[3], r[4], r[5]).asDiagonal());
    return true;
  }

  bool anywhere() {
    amcl_.set_anywhere();
    return true;
  }

  bool place() {
    const auto row = read_row<3>();
    if (!row) return false;
    const SE2 T_map_base = SE2::from_xy_yaw((*row)[0], (*row)[1], (*row)[2]);
    const SE2 T_grid_base = map_.T_map_origin.inverse() * T_map_base;
    maps::ScanPoints points;
    for (int beam = 0; beam < 90; ++beam) {
      const double angle = 2.0 * kPi * beam / 90.0;
      const double range = field_.ray(T_grid_base.p, T_grid_base.angle + angle, kLidarRange);
      if (range >= kLidarRange) continue;
      points.p_base.push_back(
          Eigen::Vector2d(range * std::cos(angle), range * std::sin(angle)).cast<float>());
    }
    double best = 0.0;
    for (const maps::PoseHypothesis& hypothesis : matcher_.match(points)) {
      const double turned = angle_difference(hypothesis.T_map_base.angle, T_map_base.angle);
      const bool is_elsewhere = (hypothesis.T_map_base.p - T_map_base.p).norm() > kElsewhere ||
                                std::abs(turned) > deg_to_rad(20.0);
      if (is_elsewhere) best = std::max(best, hypothesis.score);
    }
    std::printf("place %.4f\n", best / std::max(matcher_.score(points, T_map_base), 1e-9));
    return true;
  }

 private:
  static maps::GridMatcherParams all() {
    maps::GridMatcherParams params;
    params.keep_ratio = 0.7;
    return params;
  }

  const OccupancyGrid& map_;
  maps::DistanceField field_;
  AmclParams params_;
  Amcl amcl_;
  maps::GridMatcher matcher_;
  SE2 T_map_odom_;
};

int run(const std::string& map_file, const std::string& params_file) {
  const OccupancyGrid map = maps::load_map(map_file);
  Replay replay(map, load_yaml<AmclParams>(params_file));
  using Handler = bool (Replay::*)();
  const std::array<Handler, 4> handlers{&Replay::scan, &Replay::pose, &Replay::anywhere,
                                        &Replay::place};
  while (const auto kind = read_row<1>()) {
    const double number = (*kind)[0];
    const bool is_known = number >= 0.0 && number < static_cast<double>(handlers.size());
    if (!is_known) throw Error("record of kind " + std::to_string(number) + ", legal: 0 to 3");
    const Handler handler = handlers[static_cast<std::size_t>(number)];
    if (!(replay.*handler)()) throw Error("the last record ends too soon");
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace trident::estimation

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: amcl_replay MAP.yaml PARAMETERS.yaml < RECORDS\n", stderr);
    return 2;
  }
  try {
    return trident::estimation::run(argv[1], argv[2]);
  } catch (const trident::Error& error) {
    std::fprintf(stderr, "amcl_replay: %s\n", error.what());
    return 1;
  }
}
