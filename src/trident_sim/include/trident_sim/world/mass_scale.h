// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_sim/model.h"

namespace trident::sim {

/// Masses and inertias of all links become `factor` times those that they were made with or that
/// World::set_link_inertial() has set, whose next call ends this. What rotors spin with stays.
/// Centers of mass do not move, so snapshots from before fit. To be called between steps. Throws
/// Error for a factor outside of 0.01 to 100, or a static model.
void scale_mass(Model& model, double factor);

}  // namespace trident::sim
