// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trident_sim/param_tree.h"

namespace trident::sim {

/// Beams of a lidar or pixels of a camera, as files define them.
struct RayCount {
  double columns = 1.0, rows = 1.0;
  const char* what = "beams";

  double rays() const { return columns * rows; }
};

/// Throws Error, before anything is allocated, for a sensor that casts more rays than its element
/// `<trident:max_rays>` allows (2e7 by default, 1e9 at most), or whose buffers would take more
/// than half of the machine's memory. `sensor`: the element `<sensor>`.
void check_ray_count(const RayCount& count, const ParamNode& sensor, const std::string& owner);

}  // namespace trident::sim
