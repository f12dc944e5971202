// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trident_base/noise.h"
#include "trident_sim/model_spec.h"

namespace trident::sim {

/// Evenly spread beams in one plane: beam i of n at min + i (max - min) / (n - 1).
struct BeamFan {
  int beams = 1;
  double min_rad = 0.0, max_rad = 0.0;

  double increment_rad() const { return beams > 1 ? (max_rad - min_rad) / (beams - 1) : 0.0; }
  double angle_rad(int beam) const { return min_rad + beam * increment_rad(); }
};

/// The `<ray>` or `<lidar>` element of a sensor (sdformat.org/spec, lidar).
struct LidarSpec {
  BeamFan horizontal, vertical;
  double range_min_m = 0.0, range_max_m = 0.0, range_resolution_m = 0.0;
  GaussianNoise noise;  ///< of a range [m]
};

/// Throws Error that names sensor, element, value and legal range: no beams, too many of them
/// (check_ray_count()), angles that are not finite or run backwards, a smallest range that is not
/// below the largest.
LidarSpec read_lidar_spec(const SensorSpec& sensor, const std::string& owner);

}  // namespace trident::sim
