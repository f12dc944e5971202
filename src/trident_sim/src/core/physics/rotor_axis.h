// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_base/span.h"
#include "trident_sim/model.h"

namespace trident::sim {

// In Gazebo a rotor is a body of its own on an ODE hinge, and the hinge is held only as well as one
// solver step per dt can: the orientation of a body that spins at s is integrated by its derivative
// at the beginning of the step, so a turn w of the vehicle moves the rotor's axis by
// dt / (1 + (dt s / 2)^2) (w x r + (dt s / 2) w) instead of dt w x r, and the hinge takes back only
// the fraction erp of the error per step. The axis, and with it the thrust, therefore leans by up
// to a few degrees in fast manoeuvres, rotors of opposite spin to opposite sides. Vehicles tuned in
// Gazebo fly with this, so `rotors` timing reproduces it (step_x of the reference flights: 0.1 mm
// with it, 1.3 mm without).

/// The torque [N m, body frame] with which the hinge's pull on the rotor acts on its carrier.
Eigen::Vector3d rotor_axis_reaction(const Joint& joint, double erp, double dt_s);

/// Moves rotor_axis_body of a carrier's rotors by one step, after the carrier and the rotors' rates
/// have been moved. `w_body`: the carrier's angular velocity in its own frame.
void advance_rotor_axes(Span<Joint* const> joints, const Eigen::Vector3d& w_body, double erp,
                        double dt_s);

}  // namespace trident::sim
