// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/physics/engine_body.h"

namespace trident::sim {

/// Makes the ODE joints of `joint`, whose links have their bodies, with limits and friction. Of a
/// gearbox the reference and the shaft must be set. Throws Error for a joint that cannot be.
void make_ode_joint(const Model& model, Joint& joint, dWorldID world);
void destroy_ode_joint(Joint& joint);

/// The body that a gearbox turns in its reference, so light that it is not felt. ODE couples only
/// equal rates about one axis; a shaft that intersects the two axes at chosen angles makes any
/// ratio of them, as two bevel gears would.
std::unique_ptr<Body> make_shaft(const Model& model, const Joint& joint, dWorldID world);

/// Prepares for the next step, with the ODE bodies in place: what couples a screw's turn to its
/// travel, or a gearbox's two turns (it takes back the fraction `erp` of the error), and limits of
/// more than half a turn.
void prepare_ode_joint(Joint& joint, double erp, double dt_s);

}  // namespace trident::sim
