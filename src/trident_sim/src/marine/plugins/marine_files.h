// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "core/plugins/plugin_util.h"

namespace trident::sim {

/// The existing file that element `key` names as `path`. Throws Error.
inline std::string existing_file(const PluginContext& context, const std::string& key,
                                 const std::string& path, const std::string& base_folder = "") {
  const Resources& resources = context.world.resources();
  std::string file = resources.find(path, base_folder);
  if (file.empty() || std::filesystem::is_directory(file)) {
    context.params.refuse(key, path, "a file; searched: as given, then " + resources.searched());
  }
  return file;
}

}  // namespace trident::sim
