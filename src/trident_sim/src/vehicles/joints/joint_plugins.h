// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_sim/plugin_registry.h"

namespace trident::sim {

/// Drives joints by commands on topics.
PluginFactory joint_drive_factory();
/// Carries a model, an observer's camera say, along with another one.
PluginFactory follow_factory();

}  // namespace trident::sim
