// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace trident::sim {

enum class ModelFormat { urdf, sdf };
enum class ModelSource { file, parameter, database, standard_input };

/// Command line of spawn_model.
struct SpawnOptions {
  ModelFormat format = ModelFormat::urdf;
  ModelSource source = ModelSource::file;
  std::string source_name;  ///< file, parameter or database model; empty for standard input
  std::string model_name;
  std::string reference_frame;
  std::string gazebo_namespace = "/gazebo";
  std::optional<std::string> robot_namespace;                   ///< absent: the node's namespace
  std::string wait_for_model;                                   ///< empty: do not wait
  double x = 0.0, y = 0.0, z = 0.0;                             ///< [m]
  double roll = 0.0, pitch = 0.0, yaw = 0.0;                    ///< [rad]
  std::vector<std::pair<std::string, double>> joint_positions;  ///< [rad or m]
  bool unpause = false;
  bool package_to_model = false;
  bool delete_on_exit = false;
  bool help = false;
};

/// Text for -h.
extern const char* const kSpawnUsage;

/// Parses arguments without the program's name and without ROS remappings. A value may follow its
/// flag as the next word or after '='. Throws std::invalid_argument naming the flag, the value and
/// what is legal.
SpawnOptions parse_spawn_options(const std::vector<std::string>& arguments);

/// Replaces package:// by model:// in the file names of <mesh> elements.
std::string meshes_from_package_to_model(const std::string& xml);

/// A world that includes one model of the database.
std::string database_model_sdf(const std::string& model);

}  // namespace trident::sim
