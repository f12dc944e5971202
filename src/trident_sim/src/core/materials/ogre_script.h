// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>

#include "ogre_materials.h"
#include "trident_sim/sdf_loader.h"

namespace trident::sim {

/// The materials of an OGRE material script, by name: of each the colours and the first texture of
/// the first pass of its first technique, over those of its parent, if that is above it in the
/// script or one of Gazebo's. Colours that are not numbers ("vertexcolour") are left out, what else
/// a script says is not looked at. Throws Error that names `label`, line and what is wrong.
std::map<std::string, OgreMaterial> parse_ogre_script(const std::string& text,
                                                      const std::string& label);

/// The scripts that one document names; each is read once.
class OgreScripts {
 public:
  /// A material of a script, or of the "*.material" of a folder; nullptr: no material has that
  /// name. A script that cannot be read is one warning.
  const OgreMaterial* find(const std::string& path, const std::string& name,
                           const WarningSink& warn);
  /// True the first time it is asked for `key`, so that many visuals of one mistake are one
  /// warning.
  bool is_first(const std::string& key) { return warned_.insert(key).second; }

 private:
  using Materials = std::map<std::string, OgreMaterial>;
  const Materials& read(const std::string& file, const WarningSink& warn);

  std::map<std::string, Materials> files_;
  std::set<std::string> warned_;
};

}  // namespace trident::sim
