// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace trident::sim {

struct BenchmarkOptions {
  std::string world_file;
  std::string urdf_file;   ///< one vehicle, its namespace written as `marker`
  std::string marker;      ///< replaced by UAV1, UAV2 … in the text of urdf_file
  std::string parameters;  ///< the controller's YAML files, separated by spaces
  int vehicles = 6;
  double window_s = 60.0;     ///< simulated time of the first measured window, which is hashed
  double min_wall_s = 2.0;    ///< more windows follow until this much wall time is measured
  double airborne_z_m = 0.5;  ///< all are above it before anything is measured
  bool profile = false;
};

extern const char* const kBenchmarkUsage;

/// Throws Error naming the option, its value and what is legal.
BenchmarkOptions parse_benchmark_options(const std::vector<std::string>& arguments);

}  // namespace trident::sim
