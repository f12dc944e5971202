// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/sdf/odd_list.h"
#include "trident_sim/sdf_loader.h"

namespace trident::sim {

/// Looks at what libsdformat drops silently when it converts a URDF, before it does: links without
/// `<inertial>`, unless a fixed child brings the inertia. A mass <= 0 or an inertia that is not
/// positive definite is an odd element: it is thrown, or noted. An `<inertial>` whose mass cannot
/// be is blanked then, as Gazebo's conversion reads such a link as one without.
void check_urdf(std::string& xml, const std::string& label, const WarningSink& warn, OddList& odd);

}  // namespace trident::sim
