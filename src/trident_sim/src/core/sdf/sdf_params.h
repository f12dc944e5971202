// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sdf/sdf.hh>
#include <string_view>
#include <vector>

#include "trident_sim/model_spec.h"

namespace trident::sim {

/// An element with all below it, but for the children of a name that is left out.
ParamNode to_param_node(const sdf::ElementPtr& element, std::string_view left_out = "");

/// The `<plugin>` children of an element, which may be nullptr.
std::vector<PluginSpec> convert_plugins(const sdf::ElementPtr& owner);

}  // namespace trident::sim
