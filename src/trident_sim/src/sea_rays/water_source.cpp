// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// The water of a world's sea among what rays hit.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "rays/analytic_surface.h"
#include "trident_sim/world.h"
#include "water_surface.h"
#include "water_tiles.h"

namespace trident::sim {
namespace {

/// How strongly a lidar sees it, where it sees it at all: what water reflects straight back.
constexpr double kReflectedPercent = 2.0;

AnalyticSurfaceSpec water_spec() {
  AnalyticSurfaceSpec spec{"water", "water", "surface", kReflectedPercent, {}};
  spec.material.ambient = spec.material.diffuse = {0.02, 0.09, 0.12, 1.0};
  return spec;
}

/// The sea's surface, whose tiles all viewers share.
class WaterSource : public AnalyticSurfaceSource {
 public:
  explicit WaterSource(const World& world)
      : world_(world), tiles_(std::make_shared<WaterTiles>(world)), spec_(water_spec()) {}

  bool exists() override { return tiles_->find_sea() != nullptr; }
  const AnalyticSurfaceSpec& spec() const override { return spec_; }

  std::shared_ptr<const AnalyticSurface> surface_at(
      const Eigen::Vector3d& p_world_viewer) override {
    auto free = std::find_if(surfaces_.begin(), surfaces_.end(),
                             [](const auto& surface) { return surface.use_count() == 1; });
    if (free == surfaces_.end()) {
      free = surfaces_.insert(free, std::make_shared<WaterSurface>(tiles_));
    }
    (*free)->follow(p_world_viewer);
    return *free;
  }

  double ceiling_m() override {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const std::shared_ptr<const Sea> sea = tiles_->find_sea();
    if (sea == nullptr) return -kInfinity;
    const auto* const waves = dynamic_cast<const WaveField*>(&sea->water());
    if (waves == nullptr) return kInfinity;
    tiles_->follow(*waves);
    return waves->level_m(world_.time().seconds()) + tiles_->amplitudes_m();
  }

  void prepare(const std::vector<Eigen::Vector2d>& p_world_viewers, WorkerPool& workers) override {
    tiles_->prepare(p_world_viewers, workers);
  }

 private:
  const World& world_;
  std::shared_ptr<WaterTiles> tiles_;
  AnalyticSurfaceSpec spec_;
  std::vector<std::shared_ptr<WaterSurface>> surfaces_;  ///< some of which nobody holds any more
};

const AnalyticSurfaceRegistrar registrar([](const World& world) {
  return std::make_unique<WaterSource>(world);
});

}  // namespace

const WaterSurface* as_water(const AnalyticSurface* surface) {
  return dynamic_cast<const WaterSurface*>(surface);
}

std::shared_ptr<const WaterSurface> as_water(
    const std::shared_ptr<const AnalyticSurface>& surface) {
  return std::dynamic_pointer_cast<const WaterSurface>(surface);
}

AnalyticHit WaterSurface::intersect(const Ray& ray, double t_max) const {
  const WaterHit hit = find_hit(ray, t_max);
  if (std::isinf(hit.t)) return {};
  const Eigen::Vector3d p = ray.p_world_origin + hit.t * ray.direction_world;
  const Eigen::Vector2d slope = hit.is_far ? this->slope(p.head<2>()) : hit.slope;
  const Eigen::Vector3d up = Eigen::Vector3d(-slope.x(), -slope.y(), 1.0).normalized();
  return {hit.t, hit.begins_below ? Eigen::Vector3d(-up) : up};
}

}  // namespace trident::sim
