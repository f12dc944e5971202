// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "test_world.h"
#include "trident_control_sim/lee_plugin.h"

namespace trident::sim {

/// The world that the reference flights were recorded in, and fireflies for it.
class GoldenWorld {
 public:
  explicit GoldenWorld(const std::string& world_file);

  World* operator->() { return world_.get(); }
  /// A firefly in namespace `name`, flown by the Lee controller inside the simulator, or by nobody.
  Model& add_firefly(const std::string& name, const SE3& T_world_model, bool with_controller);
  /// An unstamped set-point: it takes effect at the next state.
  void command(const std::string& name, const Eigen::Vector3d& p_world, double yaw_rad);

 private:
  PluginRegistry registry_;
  std::unique_ptr<World> world_;
};

}  // namespace trident::sim
