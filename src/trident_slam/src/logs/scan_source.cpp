// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/scan_source.h"

#include <limits>

namespace trident::slam {

void forget_readings_at_limit(LaserScan& scan) {
  for (float& range : scan.ranges) {
    if (range >= scan.range_max) range = std::numeric_limits<float>::infinity();
  }
}

}  // namespace trident::slam
