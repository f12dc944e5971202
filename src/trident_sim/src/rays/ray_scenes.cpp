// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "ray_scenes.h"

#include "trident_sim/world.h"

namespace trident::sim {

RayScene& rays(World& world, RayGeometry geometry) {
  return world.extensions().get<RayScenes>(world).scene(geometry);
}

RayScenes::RayScenes(World& world) : world_(world), surface_source_(make_analytic_surface(world)) {}

RayScenes::~RayScenes() = default;

RayScene& RayScenes::scene(RayGeometry geometry) {
  std::unique_ptr<RayScene>& scene = scenes_[static_cast<std::size_t>(geometry)];
  if (scene == nullptr) scene = std::make_unique<RayScene>(world_, geometry, surface_source_);
  return *scene;
}

void RayScenes::begin_steps() {
  for (const auto& scene : scenes_) {
    if (scene != nullptr) scene->deferred().clear();
  }
}

/// Moves the scenes' deferred jobs into jobs_. Returns whether there are any.
bool RayScenes::collect_jobs() {
  jobs_.clear();
  for (const auto& scene : scenes_) {
    if (scene == nullptr || scene->deferred().empty()) continue;
    scene->refresh();
    const std::vector<RayJob*>& deferred = scene->deferred().jobs();
    jobs_.insert(jobs_.end(), deferred.begin(), deferred.end());
    scene->deferred().clear();
  }
  return !jobs_.empty();
}

void RayScenes::prepare_surface() {
  if (surface_source_ == nullptr) return;
  p_world_viewers_.clear();
  for (const RayJob* const job : jobs_) p_world_viewers_.push_back(job->viewer());
  surface_source_->prepare(p_world_viewers_, world_.workers());
}

void RayScenes::end_phase(Phase /*phase*/) {
  // Sensors of all models first say what they are to cast in this phase; then all rays are shared
  // among the workers, and results are published in the order of the sensors.
  if (!collect_jobs()) return;
  prepare_surface();
  parts_.clear();
  for (RayJob* const job : jobs_) {
    const std::size_t count = job->begin();
    for (std::size_t part = 0; part < count; ++part) parts_.emplace_back(job, part);
  }
  world_.workers().share(parts_.size(), [this](std::size_t i, std::size_t /*worker*/) {
    parts_[i].first->run_part(parts_[i].second);
  });
  for (RayJob* const job : jobs_) job->finish();
}

}  // namespace trident::sim
