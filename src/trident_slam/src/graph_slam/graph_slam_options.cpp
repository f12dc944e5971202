// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/graph_slam_options.h"

#include "trident_base/error.h"
#include "trident_slam/scan_matcher.h"

namespace trident::slam {

void GraphSlamOptions::validate() const {
  if (min_laser_range >= max_laser_range) {
    throw Error("min_laser_range = " + std::to_string(min_laser_range) +
                " must be below max_laser_range = " + std::to_string(max_laser_range));
  }
  try {
    make_scan_matcher(scan_matcher);
  } catch (const Error& error) {
    throw Error(std::string("scan_matcher: ") + error.what());
  }
}

}  // namespace trident::slam
