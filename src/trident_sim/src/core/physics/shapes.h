// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ode/ode.h>

#include <string>

#include "core/physics/engine_body.h"

namespace trident::sim {

/// Makes the ODE geometry of a shape, unplaced. Throws Error for a mesh or image that cannot be
/// read. `can_move`: it gets a contact margin.
EngineGeom make_geom(const CollisionSpec& spec, const std::string& scoped_name, bool can_move);
void destroy_geom(EngineGeom& geom);
/// Whether ODE knows the shape only as part of what never moves, a plane or a heightmap.
bool must_be_static(const EngineGeom& geom);
/// Places `geom`, which is not attached to a body, in the world.
void place_static_geom(EngineGeom& geom, const SE3& T_world_shape);

}  // namespace trident::sim
