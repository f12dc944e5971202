// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "ogre_materials.h"

#include <map>

namespace trident::sim {
namespace {

OgreMaterial of(const Eigen::Vector4d& ambient, const Eigen::Vector4d& diffuse) {
  OgreMaterial material;
  material.ambient = ambient;
  material.diffuse = diffuse;
  return material;
}
OgreMaterial plain(double r, double g, double b, double a = 1.0) {
  return of({r, g, b, a}, {r, g, b, a});
}

std::map<std::string, OgreMaterial> make_table() {
  // Of gazebo-classic 11, media/materials/scripts/gazebo.material.
  return {
      {"Gazebo/Grey", of({0.3, 0.3, 0.3, 1.0}, {0.7, 0.7, 0.7, 1.0})},
      {"Gazebo/Gray", of({0.3, 0.3, 0.3, 1.0}, {0.7, 0.7, 0.7, 1.0})},
      {"Gazebo/DarkGrey", plain(0.175, 0.175, 0.175)},
      {"Gazebo/DarkGray", plain(0.175, 0.175, 0.175)},
      {"Gazebo/White", plain(1.0, 1.0, 1.0)},
      {"Gazebo/FlatBlack", plain(0.1, 0.1, 0.1)},
      {"Gazebo/Black", plain(0.0, 0.0, 0.0)},
      {"Gazebo/Red", plain(1.0, 0.0, 0.0)},
      {"Gazebo/RedBright", plain(0.87, 0.26, 0.07)},
      {"Gazebo/Green", plain(0.0, 1.0, 0.0)},
      {"Gazebo/Blue", plain(0.0, 0.0, 1.0)},
      {"Gazebo/SkyBlue", of({0.13, 0.44, 0.70, 1.0}, {0.0, 0.0, 1.0, 1.0})},
      {"Gazebo/Yellow", plain(1.0, 1.0, 0.0)},
      {"Gazebo/ZincYellow", plain(0.9725, 0.9529, 0.2078)},
      {"Gazebo/DarkYellow", plain(0.7, 0.7, 0.0)},
      {"Gazebo/Purple", plain(1.0, 0.0, 1.0)},
      {"Gazebo/Turquoise", plain(0.0, 1.0, 1.0)},
      {"Gazebo/Orange", plain(1.0, 0.5088, 0.0468)},
      {"Gazebo/Indigo", plain(0.33, 0.0, 0.5)},
      {"Gazebo/Gold", of({0.4, 0.24869, 0.020759, 1.0}, {0.8, 0.64869, 0.120759, 1.0})},
      {"Gazebo/WhiteGlow", plain(1.0, 1.0, 1.0)},
      {"Gazebo/RedGlow", plain(1.0, 0.0, 0.0)},
      {"Gazebo/GreenGlow", plain(0.0, 1.0, 0.0)},
      {"Gazebo/BlueGlow", plain(0.0, 0.0, 1.0)},
      {"Gazebo/YellowGlow", plain(1.0, 1.0, 0.0)},
      {"Gazebo/PurpleGlow", plain(1.0, 0.0, 1.0)},
      {"Gazebo/TurquoiseGlow", plain(0.0, 1.0, 1.0)},
      {"Gazebo/RedTransparent", plain(1.0, 0.0, 0.0, 0.5)},
      {"Gazebo/GreenTransparent", plain(0.0, 1.0, 0.0, 0.5)},
      {"Gazebo/BlueTransparent", plain(0.0, 0.0, 1.0, 0.5)},
      {"Gazebo/GreyTransparent", plain(0.5, 0.5, 0.5, 0.5)},
      {"Gazebo/YellowTransparent", plain(1.0, 1.0, 0.0, 0.5)},
      {"Gazebo/OrangeTransparent", plain(1.0, 0.44, 0.0, 0.4)},
      {"Gazebo/BlueLaser", plain(0.0, 0.0, 1.0, 0.4)},
      {"Gazebo/Pioneer2Body",
       of({0.481193, 0.000123, 0.000123, 1.0}, {0.681193, 0.000923, 0.000923, 1.0})},
      // Pictures there; rough means of theirs here.
      {"Gazebo/Wood", plain(0.55, 0.38, 0.22)},
      {"Gazebo/WoodFloor", plain(0.52, 0.36, 0.20)},
      {"Gazebo/WoodPallet", plain(0.60, 0.47, 0.32)},
      {"Gazebo/Bricks", plain(0.55, 0.30, 0.24)},
      {"Gazebo/CeilingTiled", plain(0.75, 0.75, 0.73)},
      {"Gazebo/PaintedWall", plain(0.82, 0.80, 0.74)},
      {"Gazebo/Road", plain(0.30, 0.30, 0.30)},
      {"Gazebo/Residential", plain(0.32, 0.32, 0.32)},
      {"Gazebo/Pedestrian", plain(0.60, 0.58, 0.55)},
      {"Gazebo/Grass", plain(0.28, 0.42, 0.16)},
      {"Gazebo/PioneerBody", plain(0.70, 0.05, 0.05)},
  };
}

}  // namespace

const OgreMaterial* find_ogre_material(const std::string& name) {
  // Gazebo's scripts need not be installed.
  static const std::map<std::string, OgreMaterial> table = make_table();
  const auto it = table.find(name);
  return it == table.end() ? nullptr : &it->second;
}

}  // namespace trident::sim
