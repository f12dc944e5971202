// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "entity_lookup.h"

#include "trident_base/error.h"

namespace trident::sim {

Model& required_model(const World& world, const std::string& name) {
  Model* model = world.find_model(name);
  if (model == nullptr) throw Error("model does not exist: [" + name + "]");
  return *model;
}

Link& required_link(const World& world, const std::string& name) {
  Link* link = world.find_link(name);
  if (link != nullptr) return *link;
  throw Error("link not found, did you forget to scope the link by model name? [" + name +
              "], write it model::link");
}

Link& required_body(const World& world, const std::string& name) {
  Link* link = world.find_link(name);
  if (link == nullptr) throw Error("body does not exist: [" + name + "], write it model::link");
  return *link;
}

namespace {

/// The joint that "model::joint" names; nullptr: it does not exist, or the name has another form.
Joint* find_scoped_joint(const World& world, const std::string& name) {
  const auto split = name.find("::");
  if (split == std::string::npos) return nullptr;
  const Model* model = world.find_model(name.substr(0, split));
  return model == nullptr ? nullptr : model->find_joint(name.substr(split + 2));
}

bool is_world_frame(const std::string& name) {
  return name.empty() || name == "world" || name == "map" || name == "/map";
}

}  // namespace

Joint& required_joint(const World& world, const std::string& name) {
  if (Joint* const joint = find_scoped_joint(world, name)) return *joint;
  // gazebo_ros takes the name of a joint without its model; here it must be the only one.
  Joint* found = nullptr;
  for (const auto& [model_name, model] : world.models()) {
    Joint* joint = model->find_joint(name);
    if (joint == nullptr) continue;
    if (found != nullptr) {
      throw Error("joint [" + name + "] is in more than one model, write it model::joint");
    }
    found = joint;
  }
  if (found == nullptr) throw Error("joint not found: [" + name + "]");
  return *found;
}

ReferenceFrame find_reference_frame(const World& world, const std::string& name) {
  if (is_world_frame(name)) return {};
  const Model* model = world.find_model(name);
  const Link* link = model != nullptr ? model->canonical_link() : world.find_link(name);
  if (link == nullptr) {
    throw Error("reference frame '" + name + "' is not world, a model or a link (model::link)");
  }
  const SE3 T = model != nullptr ? model->T_world_model() : link->T_world_link();
  // A moving frame has a velocity, by which twists seen from it differ.
  return {T, link->v_world_at(T.p), link->w_world()};
}

}  // namespace trident::sim
