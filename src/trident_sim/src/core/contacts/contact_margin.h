// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ode/ode.h>

#include "core/physics/engine_body.h"
#include "trident_sim/model_spec.h"

namespace trident::sim {

/// By how much ODE's shape of something that moves is larger all round [m], so that what lies on
/// something is found in each step, though it touches by less than a double resolves, and what
/// comes slowly before it is inside. Shapes that cannot grow, meshes above all, have none.
double contact_margin(const Shape& shape);

/// Takes a contact of the larger shapes for one of the shapes themselves: place and depth, which is
/// negative where there is a gap yet.
void take_margins_off(dContactGeom& found, const EngineGeom& a, const EngineGeom& b);

}  // namespace trident::sim
