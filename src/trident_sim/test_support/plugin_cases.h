// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "plugin_conformance.h"

namespace trident::sim {

/// The case of each plugin that ships and brings an example, in order of their names.
std::vector<PluginCase> builtin_plugin_cases();

}  // namespace trident::sim
