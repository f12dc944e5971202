// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "analytic_surface.h"
#include "trident_sim/ray_scene.h"
#include "trident_sim/world/step_extension.h"

namespace trident::sim {

/// The scenes of a world, made when first asked for, and the jobs that sensors defer in them.
class RayScenes : public StepExtension {
 public:
  explicit RayScenes(World& world);
  ~RayScenes() override;

  RayScene& scene(RayGeometry geometry);

  void begin_steps() override;
  /// Runs what the sensors of the phase deferred, of both scenes together, shared by the workers.
  void end_phase(Phase phase) override;

 private:
  bool collect_jobs();
  void prepare_surface();

  World& world_;
  std::shared_ptr<AnalyticSurfaceSource> surface_source_;  ///< nullptr: none is registered
  std::array<std::unique_ptr<RayScene>, 2> scenes_;        ///< by RayGeometry
  // Memory that is kept from phase to phase.
  std::vector<RayJob*> jobs_;
  std::vector<std::pair<RayJob*, std::size_t>> parts_;
  std::vector<Eigen::Vector2d> p_world_viewers_;
};

}  // namespace trident::sim
