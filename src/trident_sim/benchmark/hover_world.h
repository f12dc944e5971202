// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "benchmark_options.h"
#include "trident_sim/world.h"

namespace trident::sim {

/// A world with vehicles on a grid of 2 m, each commanded to hover 1 m above the ground at its
/// place. The controllers are plugins with the node's timing and arithmetic, so the flight is, bit
/// for bit, that of the same vehicles with controller nodes in lockstep.
class HoverWorld {
 public:
  /// Throws Error.
  explicit HoverWorld(const BenchmarkOptions& options);

  World& world() { return *world_; }
  /// Steps by whole simulated seconds until all are above `z_m`; throws Error after 30 s.
  void take_off(double z_m);
  /// The lowest vehicle's height [m].
  double lowest_z_m() const;
  /// The largest distance of a vehicle from the place it is commanded to keep [m].
  double largest_offset_m() const;
  void step_seconds(double seconds);

 private:
  void spawn_vehicle(int index, const std::string& urdf, const BenchmarkOptions& options);

  Resources resources_;
  PluginRegistry registry_;
  std::unique_ptr<World> world_;
  std::map<std::string, Eigen::Vector3d> p_world_goal_;
};

}  // namespace trident::sim
