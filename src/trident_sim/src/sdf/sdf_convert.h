// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <sdf/sdf.hh>
#include <string>

#include "ogre_script.h"
#include "trident_sim/sdf_loader.h"

namespace trident {

/// Where a document comes from: for finding its files and for naming it in errors.
struct ConvertContext {
  const Resources& resources;
  const std::string& label;
  std::string base_folder;
  const WarningSink& warn;
  std::shared_ptr<OgreScripts> scripts = std::make_shared<OgreScripts>();
};

WorldSpec convert_world(const sdf::World& world, const ConvertContext& context);
ModelSpec convert_model(const sdf::Model& model, const ConvertContext& context);

}  // namespace trident
