// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace trident::nav {

/// The name of a plugin with a slash: `package::Class`, as Nav2's files have it, and ROS 1's
/// `package/Class` are the same.
inline std::string with_slash(std::string name) {
  const std::size_t at = name.find("::");
  if (at != std::string::npos) name.replace(at, 2, "/");
  return name;
}

}  // namespace trident::nav
