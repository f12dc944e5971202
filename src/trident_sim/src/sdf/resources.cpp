// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/resources.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace trident {
namespace fs = std::filesystem;
namespace {

void append_path_list(const char* variable, std::vector<std::string>& folders) {
  const char* value = std::getenv(variable);
  if (value == nullptr) return;
  const std::string list(value);
  std::size_t begin = 0;
  while (begin <= list.size()) {
    const std::size_t end = std::min(list.find(':', begin), list.size());
    const std::string folder = list.substr(begin, end - begin);
    // Launch files of RotorS leave a literal ${GAZEBO_MODEL_PATH} behind: roslaunch does not expand
    // it.
    if (!folder.empty() && folder[0] != '$') folders.push_back(folder);
    begin = end + 1;
  }
}

bool present(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

/// Package folder below `root`, as deep as workspaces nest them.
std::string find_package_below(const fs::path& root, std::string_view package, int depth) {
  if (root.filename() == package && present(root / "package.xml")) return root.string();
  if (present(root / package / "package.xml")) return (root / package).string();
  if (depth == 0 || present(root / "CATKIN_IGNORE")) return "";
  std::error_code ignored;
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(root, ignored)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory(ignored) && !name.empty() && name[0] != '.') {
      folders.push_back(entry.path());
    }
  }
  std::sort(folders.begin(), folders.end());
  for (const fs::path& folder : folders) {
    if (present(folder / "package.xml")) continue;
    if (std::string found = find_package_below(folder, package, depth - 1); !found.empty()) {
      return found;
    }
  }
  return "";
}

}  // namespace

Resources::Resources(std::vector<std::string> extra_folders)
    : model_folders_(std::move(extra_folders)) {
  append_path_list("GAZEBO_MODEL_PATH", model_folders_);
  append_path_list("GAZEBO_RESOURCE_PATH", model_folders_);
  append_path_list("ROS_PACKAGE_PATH", package_folders_);
}

const std::string& Resources::find_package(std::string_view package) const {
  const auto [entry, is_new] = packages_.try_emplace(std::string(package));
  for (const std::string& folder : package_folders_) {
    if (!is_new || !entry->second.empty()) break;
    entry->second = find_package_below(folder, package, 3);
  }
  return entry->second;
}

std::string Resources::find(std::string_view uri, std::string_view base_folder) const {
  const auto scheme_end = uri.find("://");
  const std::string_view scheme =
      scheme_end == std::string_view::npos ? "" : uri.substr(0, scheme_end);
  const std::string_view rest =
      scheme_end == std::string_view::npos ? uri : uri.substr(scheme_end + 3);
  if (scheme == "file" || (scheme.empty() && !rest.empty() && rest.front() == '/')) {
    if (present(rest)) return std::string(rest);
    if (scheme.empty()) return "";
  }
  if (scheme.empty() && !base_folder.empty() && present(fs::path(base_folder) / rest)) {
    return (fs::path(base_folder) / rest).string();
  }
  for (const std::string& folder : model_folders_) {
    if (present(fs::path(folder) / rest)) return (fs::path(folder) / rest).string();
  }
  // libsdformat turns a URDF's package:// into model://, so either may mean a package.
  if (scheme == "package" || scheme == "model") {
    const auto slash = rest.find('/');
    const std::string& package = find_package(rest.substr(0, slash));
    if (!package.empty()) {
      const fs::path path = slash == std::string_view::npos
                                ? fs::path(package)
                                : fs::path(package) / rest.substr(slash + 1);
      if (present(path)) return path.string();
    }
  }
  if (scheme.empty() && present(rest)) return std::string(rest);
  return "";
}

std::string Resources::searched() const {
  std::string text;
  for (const auto* list : {&model_folders_, &package_folders_}) {
    for (const std::string& folder : *list) text += (text.empty() ? "" : ":") + folder;
  }
  return text.empty() ? "nothing (GAZEBO_MODEL_PATH and ROS_PACKAGE_PATH are empty)" : text;
}

}  // namespace trident
