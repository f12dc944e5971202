// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "simulated_robot.h"
#include "trial_config.h"
#include "trident_base/occupancy_grid.h"
#include "trident_base/se2.h"
#include "trident_estimation/amcl.h"

namespace trident::benchmarks {

/// Where a map lies under a robot's odometry, by the method that a task asks for.
class MapLocalizer {
 public:
  /// `T_map_start`: where the robot truly begins; amcl gets it with an error that the seed
  /// draws. Throws Error, ConfigError.
  MapLocalizer(const MapParams& params, const OccupancyGrid& map, const SE2& T_map_start,
               std::uint64_t seed);

  /// Moves amcl's particles.
  void add_scan(const PlacedScan& placed);
  /// `T_map_base`: the truth, for Localization::kTruth alone.
  void set_truth(const SE2& T_map_base, const SE2& T_odom_base);
  const SE2& T_map_odom() const { return T_map_odom_; }

 private:
  Localization how_;
  std::unique_ptr<estimation::Amcl> filter_;  ///< Of kAmcl.
  SE2 T_map_odom_;
};

}  // namespace trident::benchmarks
