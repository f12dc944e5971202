// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "models.h"
#include "test_world.h"
#include "trident_base/random_stream.h"
#include "trident_sim/ray_scene.h"

namespace trident::sim {

/// Random numbers of a test, one after another.
class Draw {
 public:
  explicit Draw(const std::string& name) : stream_(7, name) {}
  double uniform(double low, double high) {
    return low + (high - low) * stream_.uniform(next_++, 0);
  }
  Eigen::Vector3d point(double half_extent) {
    return {uniform(-half_extent, half_extent), uniform(-half_extent, half_extent),
            uniform(-half_extent, half_extent)};
  }
  Eigen::Vector3d direction() {
    while (true) {
      const Eigen::Vector3d v = point(1.0);
      if (v.norm() > 0.1 && v.norm() < 1.0) return v.normalized();
    }
  }
  SE3 pose(double half_extent) {
    return SE3::from_xyz_rpy(point(half_extent), uniform(-3.0, 3.0), uniform(-1.5, 1.5),
                             uniform(-3.0, 3.0));
  }

 private:
  RandomStream stream_;
  std::uint64_t next_ = 0;
};

/// The scene of a world, following it.
inline RayScene& fresh_rays(TestWorld& world, RayGeometry geometry = RayGeometry::kCollision) {
  RayScene& scene = rays(*world, geometry);
  scene.refresh();
  return scene;
}

inline Ray ray_along(const Eigen::Vector3d& p_world_origin, const Eigen::Vector3d& direction) {
  return {p_world_origin, direction.normalized()};
}

inline RayHit cast_one(const RayScene& scene, const Ray& ray, const RayFilter& filter = {}) {
  RayHit hit;
  scene.cast({&ray, 1}, {&hit, 1}, filter);
  return hit;
}

inline double range(const RayScene& scene, const Eigen::Vector3d& p, const Eigen::Vector3d& along,
                    const RayFilter& filter = {}) {
  return cast_one(scene, ray_along(p, along), filter).distance_m;
}

inline std::vector<RayHit> cast_all(const RayScene& scene, const std::vector<Ray>& rays,
                                    const RayFilter& filter = {}) {
  std::vector<RayHit> hits(rays.size());
  scene.cast(rays, hits, filter);
  return hits;
}

/// One link "link" of one visual "visual".
inline ModelSpec make_visual(const std::string& name, const Shape& shape, const SE3& T_world_model,
                             const Material& material = {}) {
  ModelSpec model = make_body(name, shape, T_world_model);
  model.links[0].collisions.clear();
  VisualSpec visual;
  visual.name = "visual";
  visual.shape = shape;
  visual.material = material;
  model.links[0].visuals.push_back(visual);
  return model;
}

}  // namespace trident::sim
