// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "trident_base/worker_pool.h"
#include "trident_sim/model_spec.h"
#include "trident_sim/ray_scene.h"

namespace trident::sim {

/// Where a ray hits an analytic surface first.
struct AnalyticHit {
  double t = std::numeric_limits<double>::infinity();  ///< along the ray; infinite: no hit
  /// Of unit length, against the ray.
  Eigen::Vector3d normal_world = Eigen::Vector3d::UnitZ();
};

/// A surface that is a function of place rather than a shape of a model, such as the water of a
/// sea, at one moment. Any number of threads may ask at the same time.
class AnalyticSurface {
 public:
  virtual ~AnalyticSurface() = default;
  /// The first hit between ray.t_min_m and t_max. Directions may have any length.
  virtual AnalyticHit intersect(const Ray& ray, double t_max) const = 0;
};

/// How an analytic surface appears among the shapes of a scene.
struct AnalyticSurfaceSpec {
  std::string model, link, name;
  double laser_retro = 0.0;  ///< see RayShape
  Material material;         ///< in visual scenes
};

/// The analytic surface of a world, shared by all its scenes. Only one thread may call it at a
/// time.
class AnalyticSurfaceSource {
 public:
  virtual ~AnalyticSurfaceSource() = default;
  /// Whether the world has the surface now.
  virtual bool exists() = 0;
  virtual const AnalyticSurfaceSpec& spec() const = 0;
  /// The surface as it is now for a viewer there. It stays as it is for as long as it is held.
  /// exists() must hold.
  virtual std::shared_ptr<const AnalyticSurface> surface_at(
      const Eigen::Vector3d& p_world_viewer) = 0;
  /// No point of the surface is higher now [m]; minus infinity where none exists.
  virtual double ceiling_m() = 0;
  /// Computes what surface_at() needs for all of these viewers, shared by the workers.
  virtual void prepare(const std::vector<Eigen::Vector2d>& p_world_viewers,
                       WorkerPool& workers) = 0;
};

using AnalyticSurfaceFactory =
    std::function<std::unique_ptr<AnalyticSurfaceSource>(const World& world)>;

/// At namespace scope, gives worlds their analytic surface. A program has at most one.
class AnalyticSurfaceRegistrar {
 public:
  explicit AnalyticSurfaceRegistrar(AnalyticSurfaceFactory factory);
};

/// The source that the registered factory makes for `world`; nullptr where none is registered.
std::shared_ptr<AnalyticSurfaceSource> make_analytic_surface(const World& world);

}  // namespace trident::sim
