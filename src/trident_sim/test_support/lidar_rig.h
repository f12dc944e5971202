// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "models.h"
#include "test_world.h"
#include "trident_base/angle.h"

namespace trident::sim {

/// A lidar as plain data; one ring unless `rings` says otherwise.
struct LidarOptions {
  std::string file = "libgazebo_ros_laser.so", type = "ray";
  int beams = 360;
  double min_rad = 0.0, max_rad = 2.0 * kPi * 359.0 / 360.0;
  int rings = 1;
  double lowest_rad = 0.0, highest_rad = 0.0;
  double range_min_m = 0.1, range_max_m = 10.0;
  double rate_hz = 10.0, stddev_m = 0.0;
  ParamList params;  ///< of the plugin, besides the namespace r and the topic scan
  SE3 T_link_sensor;
};
SensorSpec make_lidar(const LidarOptions& options);

/// A small body that carries the lidar, weightless; its frame is r/link, its port r/scan.
ModelSpec robot_with(const LidarOptions& options, const SE3& T_world_model = {});

/// A square room of half width `half_m` around the origin, 2 m high or as given.
void add_walls(TestWorld& world, double half_m, double height_m = 2.0);
/// How far away its wall is from the middle.
double wall_range(double half_m, double angle);

}  // namespace trident::sim
