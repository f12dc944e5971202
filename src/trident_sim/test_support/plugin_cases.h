// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "plugin_conformance.h"

namespace trident::sim {

/// A complete case of each plugin that ships and has a port with numbers.
std::vector<PluginCase> builtin_plugin_cases();

}  // namespace trident::sim
