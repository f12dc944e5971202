// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "core/physics/engine_body.h"
#include "trident_sim/world/axis_params.h"

namespace trident::sim {

/// Gives `body` the inertia of its links as model.spec has them now. Its origin moves to the new
/// centre of mass; links, shapes, joints and motion stay what and where they are. The ODE bodies of
/// the model are left as spawned: their state must be pushed.
void recompose(Model& model, EngineBody& body);

/// Changes an axis of an ODE joint. Throws Error, and changes nothing, for a value out of range or
/// one that this kind of joint does not have.
void set_axis_params(Joint& joint, std::size_t axis, const AxisParams& params);

}  // namespace trident::sim
