// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/model.h"

#include "core/physics/engine_body.h"

namespace trident::sim {

Link* Model::find_link(const std::string& link_name) const {
  for (const auto& link : links) {
    if (link->name == link_name) return link.get();
  }
  return nullptr;
}

std::vector<Geom*> Model::collision_shapes(const Link& link) const {
  std::vector<Geom*> result;
  if (link.body != nullptr) {
    for (EngineGeom& geom : engine_body(link.body)->geoms) result.push_back(&geom);
  } else if (static_geoms != nullptr) {
    for (EngineGeom& geom : static_geoms->geoms) result.push_back(&geom);
  }
  return result;
}

bool Model::has_static_shapes() const {
  return static_geoms != nullptr && !static_geoms->geoms.empty();
}

Joint* Model::find_joint(const std::string& joint_name) const {
  for (const auto& joint : joints) {
    if (joint->spec.name == joint_name) return joint.get();
  }
  return nullptr;
}

SE3 Model::T_world_model() const {
  if (links.empty()) return T_world_model_initial;
  return links.front()->T_world_link() * spec.links.front().T_model_link.inverse();
}

}  // namespace trident::sim
