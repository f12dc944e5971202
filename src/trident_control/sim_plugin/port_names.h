// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace trident::control {

/// "<ns>/<topic>" without outer slashes.
inline std::string join_namespace(const std::string& ns, const std::string& topic) {
  const auto first = ns.find_first_not_of('/');
  if (first == std::string::npos) return topic;
  return ns.substr(first, ns.find_last_not_of('/') - first + 1) + "/" + topic;
}

}  // namespace trident::control
