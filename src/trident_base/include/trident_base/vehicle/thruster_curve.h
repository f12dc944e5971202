// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_base/vehicle/thruster_params.h"

namespace trident {

/// VRX' generalised logistic function, thrust [N] of a command in [-1, 1]:
/// T = A + (K - A) / (C + exp(-B (x - M)))^(1 / nu), one set of constants ahead (x > 0.01), one
/// astern (x < -0.01), nothing between.
double vrx_glf_thrust(double command);

/// Steady thrust [N] of a propeller whose state n is at a command (or [rad/s] where that is one):
///   linear     n / max_command max_force_forward, or n / |min_command| max_force_reverse
///   glf        vrx_glf_thrust(n)
///   quadratic  K n|n|, K for either direction
///   table      linear between the points, constant beyond them
/// cut to [-max_force_reverse, max_force_forward]. The dead band is the command's, not the curve's.
double thrust_at(const ThrusterParams& params, double state);

/// The command in [min_command, max_command] whose steady thrust is nearest to `thrust_n`; of two
/// that are equally near the one nearer to 0. A command within the dead band gives none. Wants a
/// curve that does not fall.
double command_for(const ThrusterParams& params, double thrust_n);

/// Throws Error naming the thruster when its table falls, so that command_for() has no answer.
void check_invertible(const ThrusterParams& params);

}  // namespace trident
