// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace trident::sim {

class PackageIndex;

/// Finds what SDF, URDF and launch files name: `model://`, `package://`, `file://`, absolute and
/// relative paths. Search order: explicit folders, GAZEBO_MODEL_PATH, GAZEBO_RESOURCE_PATH,
/// packages of ROS_PACKAGE_PATH by gazebo_ros' gazebo_model_path and gazebo_media_path, for
/// relative files (media/ or Media/)models of these, for `package://` and `model://` the packages
/// themselves, and at last what comes with the simulator, whatever the variables say. Copies share
/// the findings.
class Resources {
 public:
  /// Takes the environment's search paths; `extra_folders` come first.
  explicit Resources(std::vector<std::string> extra_folders = {});

  /// The existing file or folder that `uri` means, or "" if it does not exist.
  /// `base_folder`: where the naming file lies, for relative paths.
  std::string find(std::string_view uri, std::string_view base_folder = "") const;
  /// Folders searched, for error messages.
  std::string searched() const;

  /// Where plugins' shared objects may lie: GAZEBO_PLUGIN_PATH, then what packages export as
  /// gazebo_ros' plugin_path.
  std::vector<std::string> plugin_folders() const;

  /// What is odd about the search paths, one sentence each.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  std::vector<std::string> take_variable(const char* variable);
  std::string find_in_packages(std::string_view rest) const;
  std::vector<std::string> exported_folders() const;

  std::vector<std::string> model_folders_, plugin_folders_, shipped_folders_, warnings_;
  std::shared_ptr<const PackageIndex> packages_;
};

}  // namespace trident::sim
