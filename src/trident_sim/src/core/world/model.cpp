// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/model.h"

namespace trident::sim {

Link* Model::find_link(const std::string& link_name) const {
  for (const auto& link : links) {
    if (link->name == link_name) return link.get();
  }
  return nullptr;
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
