// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/world/model_set.h"

#include "core/physics/physics_engine.h"

namespace trident::sim {

// Here, where the engine is a complete type.
ModelSet::ModelSet() = default;
ModelSet::~ModelSet() = default;

Model* ModelSet::find_model(const std::string& name) const {
  const auto it = models_.find(name);
  return it == models_.end() ? nullptr : it->second.get();
}

/// A name without a model must be unique: the second link of that name makes it ambiguous.
Link* ModelSet::find_link(const std::string& scoped_name) const {
  const auto split = scoped_name.find("::");
  if (split != std::string::npos) {
    Model* model = find_model(scoped_name.substr(0, split));
    if (model != nullptr) return model->find_link(scoped_name.substr(split + 2));
  }
  Link* found = nullptr;
  for (const auto& [name, model] : models_) {
    Link* link = model->find_link(scoped_name);
    if (link == nullptr) continue;
    if (found != nullptr) return nullptr;
    found = link;
  }
  return found;
}

}  // namespace trident::sim
