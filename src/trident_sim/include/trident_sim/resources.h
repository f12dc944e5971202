// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace trident {

/// Finds files that SDF, URDF and launch files name: `model://`, `package://`, `file://`, absolute
/// and relative paths. Search order: explicit folders, GAZEBO_MODEL_PATH, GAZEBO_RESOURCE_PATH, and
/// for `package://` the folders of ROS_PACKAGE_PATH (a package is a folder with a package.xml).
class Resources {
 public:
  /// Takes the environment's search paths; `extra_folders` come first.
  explicit Resources(std::vector<std::string> extra_folders = {});

  /// The existing file or folder that `uri` means, or "" when there is none.
  /// `base_folder`: where the naming file lies, for relative paths.
  std::string find(std::string_view uri, std::string_view base_folder = "") const;
  /// Folders searched, for error messages.
  std::string searched() const;

 private:
  const std::string& find_package(std::string_view package) const;

  std::vector<std::string> model_folders_;
  std::vector<std::string> package_folders_;
  mutable std::map<std::string, std::string> packages_;  ///< name -> folder, "" when not found
};

}  // namespace trident
