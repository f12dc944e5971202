// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/physics/engine_body.h"

namespace trident::sim {

/// Puts the ODE bodies of `model` where they were spawned, without their velocities.
void place_as_spawned(const Model& model);

/// Sets anchor, axes and zero positions of an ODE joint, and their inertia, while the ODE bodies
/// are where they were spawned. Throws Error for axes that the joint cannot have.
void anchor_joint(const Model& model, Joint& joint);

}  // namespace trident::sim
