// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tinyxml2.h>

#include <string>

#include "trident_sim/sdf_loader.h"

namespace trident::sim {

/// Warns of every kind of element of a URDF that has no effect here, once, with the line of its
/// first and how often it is there.
void report_ignored_elements(const tinyxml2::XMLElement& robot, const std::string& label,
                             const WarningSink& warn);

}  // namespace trident::sim
