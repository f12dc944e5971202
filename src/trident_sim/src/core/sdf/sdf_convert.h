// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <sdf/sdf.hh>
#include <string>

#include "core/materials/ogre_script.h"
#include "core/resources/missing_files.h"
#include "odd_list.h"
#include "trident_sim/sdf_loader.h"

namespace trident::sim {

/// Where a document comes from: for finding its files and for naming it in errors.
struct ConvertContext {
  const Resources& resources;
  const std::string& label;
  std::string base_folder;
  const WarningSink& warn;
  OddList& odd;
  MissingFiles& missing;
  /// Whether lines and paths of elements are those of the user's files.
  bool has_places = true;
  /// The file that a path of libsdformat means.
  std::function<std::string(const std::string&)> original{};
  std::shared_ptr<OgreScripts> scripts = std::make_shared<OgreScripts>();
};

/// The text of a fault with file and line in place of the document's name.
std::string placed(const std::string& fault, const sdf::ElementPtr& element,
                   const ConvertContext& context);

WorldSpec convert_world(const sdf::World& world, const ConvertContext& context);
ModelSpec convert_model(const sdf::Model& model, const ConvertContext& context);

}  // namespace trident::sim
