// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sdf/sdf.hh>
#include <string>

#include "core/sdf/sdf_convert.h"

namespace trident::sim {

/// Fills in material, transparency, shadows and visibility of a visual. A texture that is not found
/// is one warning.
void convert_look(const sdf::Visual& from, const std::string& what, const ConvertContext& context,
                  VisualSpec& visual);

/// Throws Error for a direction of no length.
LightSpec convert_light(const sdf::Light& from, const ConvertContext& context);

SceneSpec convert_scene(const sdf::World& world);

}  // namespace trident::sim
