// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/plugins/plugin_util.h"
#include "marine/environment/environment_params.h"

namespace trident::sim {

/// Of libtrident_sea.so: the file <environment>, or its keys as elements. Throws Error.
EnvironmentParams read_environment(const PluginContext& context);

/// VRX' <wave>, with the defaults of its code. Throws Error.
EnvironmentParams read_vrx_waves(const PluginContext& context);

/// Turns the names of files into paths that exist; `folder`: for relative ones. Throws Error.
void find_files(const Resources& resources, const std::string& folder, EnvironmentParams* params);

}  // namespace trident::sim
