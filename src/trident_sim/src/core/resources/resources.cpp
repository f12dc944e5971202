// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/resources.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <set>

#include "package_index.h"

namespace trident::sim {
namespace fs = std::filesystem;
namespace {

std::vector<std::string> split_path_list(const std::string& list) {
  std::vector<std::string> folders;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(':', begin), list.size());
    if (end > begin) folders.push_back(list.substr(begin, end - begin));
    begin = end + 1;
  }
  return folders;
}

bool present(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

/// roslaunch sets variables as they are written: it expands no ${NAME}.
bool is_unexpanded(const std::string& folder) {
  return folder[0] == '$' || folder.find("${") != std::string::npos;
}

/// Upstream's launch files set `NAME` to "${NAME}:…", and mean what is found last in any case.
bool names_search_path(const std::string& folder) {
  static const std::set<std::string> kKnown{"${GAZEBO_MODEL_PATH}",  "${GAZEBO_RESOURCE_PATH}",
                                            "${GAZEBO_PLUGIN_PATH}", "$GAZEBO_MODEL_PATH",
                                            "$GAZEBO_RESOURCE_PATH", "$GAZEBO_PLUGIN_PATH"};
  return kKnown.count(folder) > 0;
}

std::string normal(const std::string& folder) {
  std::string text = fs::path(folder).lexically_normal().string();
  if (text.size() > 1 && text.back() == '/') text.pop_back();
  return text;
}

std::string find_in(const std::vector<std::string>& folders, std::string_view rest) {
  for (const std::string& folder : folders) {
    if (present(fs::path(folder) / rest)) return (fs::path(folder) / rest).string();
  }
  return "";
}

/// Gazebo looks for a file by its bare name in these folders, too, of each that holds media.
std::string find_among_media(const std::vector<std::string>& folders, std::string_view rest) {
  for (const std::string& folder : folders) {
    for (const char* media : {"models", "media/models", "Media/models"}) {
      const fs::path path = fs::path(folder) / media / rest;
      if (present(path)) return path.string();
    }
  }
  return "";
}

/// What is asked for, divided at "://"; without it there is no scheme.
struct Uri {
  explicit Uri(std::string_view uri) {
    const auto end = uri.find("://");
    if (end != std::string_view::npos) scheme = uri.substr(0, end);
    rest = end == std::string_view::npos ? uri : uri.substr(end + 3);
  }
  bool is_absolute() const { return !rest.empty() && rest.front() == '/'; }
  bool is_absolute_path() const { return scheme.empty() && is_absolute(); }
  /// Media are named by a bare name or path, with file:// or nothing before it.
  bool may_be_media() const {
    return (scheme.empty() || scheme == "file") && !rest.empty() && !is_absolute();
  }
  /// libsdformat turns a URDF's package:// into model://, so either may mean a package.
  bool may_be_in_package() const { return scheme == "package" || scheme == "model"; }

  std::string_view scheme, rest;
};

std::string if_present(const fs::path& path) { return present(path) ? path.string() : ""; }

/// As the file system has it: file:// from the root or the working folder, a plain path from the
/// folder of the file that names it.
std::string find_as_path(const Uri& uri, std::string_view base_folder) {
  if (uri.scheme == "file") return if_present(uri.rest);
  if (!uri.scheme.empty() || base_folder.empty()) return "";
  return if_present(fs::path(base_folder) / uri.rest);
}

/// The first answer that is not empty; later searches are not made then.
std::string first_found(std::initializer_list<std::function<std::string()>> searches) {
  for (const auto& search : searches) {
    if (std::string found = search(); !found.empty()) return found;
  }
  return "";
}

void append(const std::vector<std::string>& folders, std::string& text) {
  for (const std::string& folder : folders) text += (text.empty() ? "" : ":") + folder;
}

}  // namespace

Resources::Resources(std::vector<std::string> extra_folders)
    : model_folders_(std::move(extra_folders)) {
  const std::string shipped = TRIDENT_SHIPPED_FOLDER;
  shipped_folders_ = {shipped + "/worlds/models", shipped, shipped + "/worlds"};
  for (const char* variable : {"GAZEBO_MODEL_PATH", "GAZEBO_RESOURCE_PATH"}) {
    for (std::string& folder : take_variable(variable)) {
      const bool is_shipped = std::count(shipped_folders_.begin(), shipped_folders_.end(),
                                         normal(folder)) > 0;  // has its place at the end
      if (!is_shipped) model_folders_.push_back(std::move(folder));
    }
  }
  plugin_folders_ = take_variable("GAZEBO_PLUGIN_PATH");
  packages_ = std::make_shared<PackageIndex>(take_variable("ROS_PACKAGE_PATH"));
}

std::vector<std::string> Resources::take_variable(const char* variable) {
  const char* const value = std::getenv(variable);
  std::vector<std::string> folders = split_path_list(value == nullptr ? "" : value);
  folders.erase(std::remove_if(folders.begin(), folders.end(), names_search_path), folders.end());
  const auto odd = std::find_if(folders.begin(), folders.end(), is_unexpanded);
  if (odd == folders.end()) return folders;
  warnings_.push_back(std::string(variable) + " holds '" + *odd +
                      "', which nobody has expanded (roslaunch knows $(env NAME) and "
                      "$(optenv NAME)); it is ignored");
  folders.erase(std::remove_if(odd, folders.end(), is_unexpanded), folders.end());
  return folders;
}

std::vector<std::string> Resources::exported_folders() const {
  std::vector<std::string> folders;
  for (const char* attribute : {"gazebo_model_path", "gazebo_media_path"}) {
    for (const std::string& list : packages_->exports("gazebo_ros", attribute)) {
      for (std::string& folder : split_path_list(list)) folders.push_back(std::move(folder));
    }
  }
  return folders;
}

std::vector<std::string> Resources::plugin_folders() const {
  std::vector<std::string> folders = plugin_folders_;
  for (const std::string& list : packages_->exports("gazebo_ros", "plugin_path")) {
    for (std::string& folder : split_path_list(list)) folders.push_back(std::move(folder));
  }
  return folders;
}

std::string Resources::find_in_packages(std::string_view rest) const {
  const auto slash = rest.find('/');
  const std::string package = packages_->find(rest.substr(0, slash));
  if (package.empty()) return "";
  const fs::path path = slash == std::string_view::npos
                            ? fs::path(package)
                            : fs::path(package) / rest.substr(slash + 1);
  return present(path) ? path.string() : "";
}

std::string Resources::find(std::string_view uri, std::string_view base_folder) const {
  const Uri parts(uri);
  const std::string_view rest = parts.rest;
  if (parts.is_absolute_path()) return if_present(rest);
  const std::string none;
  // The user's own folders come first, what this project ships comes last.
  return first_found({
      [&] { return find_as_path(parts, base_folder); },
      [&] { return find_in(model_folders_, rest); },
      [&] { return find_in(exported_folders(), rest); },
      [&] { return parts.may_be_media() ? find_among_media(model_folders_, rest) : none; },
      [&] { return parts.may_be_media() ? find_among_media(exported_folders(), rest) : none; },
      [&] { return parts.may_be_in_package() ? find_in_packages(rest) : none; },
      [&] { return parts.scheme.empty() ? if_present(rest) : none; },
      [&] { return find_in(shipped_folders_, rest); },
  });
}

std::string Resources::searched() const {
  std::string text;
  append(model_folders_, text);
  append(exported_folders(), text);
  append(packages_->roots(), text);
  append(shipped_folders_, text);
  return text;
}

}  // namespace trident::sim
