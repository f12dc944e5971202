// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>

namespace trident::sim {

/// OGRE's defaults.
struct OgreMaterial {
  Eigen::Vector4d ambient{1.0, 1.0, 1.0, 1.0}, diffuse{1.0, 1.0, 1.0, 1.0};
  Eigen::Vector4d specular{0.0, 0.0, 0.0, 1.0}, emissive{0.0, 0.0, 0.0, 1.0};
  std::string texture;  ///< name of a picture's file; "": none
};

/// Colours of a material that Gazebo classic ships ("Gazebo/Grey"); a textured one has the mean
/// colour of what it shows. nullptr: not one of those.
const OgreMaterial* find_ogre_material(const std::string& name);

}  // namespace trident::sim
