// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_sim/plugin_registry.h"

namespace trident::sim {

PluginFactory joint_drive_factory();

}  // namespace trident::sim
