// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// How far models stand inside each other, apart from any step.
#include "contact_margin.h"
#include "core/physics/body_sync.h"
#include "core/physics/physics_engine.h"

namespace trident::sim {
namespace {

Eigen::Vector3d bound_center_world(const EngineBody& body) {
  return body.T_world_body.p + body.R_world_body * body.bound_center;
}

bool bounds_overlap(const EngineBody& a, const EngineBody& b) {
  if (a.bound_radius_m <= 0.0 || b.bound_radius_m <= 0.0) return false;
  const double reach = a.bound_radius_m + b.bound_radius_m;
  return (bound_center_world(a) - bound_center_world(b)).squaredNorm() <= reach * reach;
}

}  // namespace

void PhysicsEngine::measure_overlap(const EngineGeom& own, const EngineGeom& other,
                                    std::optional<Overlap>& deepest) {
  if ((own.surface.collide_bitmask & other.surface.collide_bitmask) == 0) return;
  const int found = dCollide(own.id, other.id, static_cast<int>(contact_buffer_.size()),
                             &contact_buffer_[0].geom, sizeof(dContact));
  for (int i = 0; i < found; ++i) {
    dContactGeom& contact = contact_buffer_[static_cast<std::size_t>(i)].geom;
    take_margins_off(contact, own, other);
    const double depth_m = contact.depth;
    if (deepest && depth_m <= deepest->depth_m) continue;
    deepest = Overlap{own.name, other.name, depth_m};
  }
}

std::optional<PhysicsEngine::Overlap> PhysicsEngine::deepest_overlap(const Model& model) {
  std::optional<Overlap> deepest;
  for (const auto& own_body : model.bodies) {
    const EngineBody* const body = engine_body(own_body.get());
    // Without shapes.
    if (body->bound_radius_m <= 0.0) continue;
    push(*body);
    for (const StaticGeom& other : statics_) {
      for (const EngineGeom& own : body->geoms) measure_overlap(own, *other.geom, deepest);
    }
    for (const EngineBody* other : bodies_) {
      if (other->owner == body->owner || !bounds_overlap(*body, *other)) continue;
      push(*other);
      for (const EngineGeom& own : body->geoms) {
        for (const EngineGeom& theirs : other->geoms) measure_overlap(own, theirs, deepest);
      }
    }
  }
  return deepest;
}

}  // namespace trident::sim
