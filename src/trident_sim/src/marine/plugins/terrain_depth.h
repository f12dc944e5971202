// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "marine/environment/seabed.h"
#include "trident_sim/world.h"

namespace trident::sim {

/// The ground that `params` means, whose file is a path that exists: of that file, or of the
/// heightmaps of the world's static models as they are now. nullptr: none. Throws Error.
std::shared_ptr<const Seabed> make_seabed(const BathymetryParams& params, const World& world);

}  // namespace trident::sim
