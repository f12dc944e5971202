// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ode/ode.h>

#include "trident_sim/model_spec.h"

namespace trident::sim {

/// Contact parameters of a pair, combined as Gazebo combines them: springs in series, dampers in
/// parallel, the smaller friction and restitution.
dSurfaceParameters combine_surfaces(const Surface& a, const Surface& b, double dt_s);

/// How far a pair may sink into each other, what of the speed at which it is parted may remain, and
/// that speed itself at most.
struct Correction {
  double min_depth_m, max_vel_m_s, most_m_s;
};

/// `b`: nullptr when it is static. As in Gazebo a static surface has no say, of two bodies the
/// smaller value counts, and the world's maximum speed bounds them all.
Correction combine_corrections(const Surface& a, const Surface* b, const PhysicsSpec& world);

}  // namespace trident::sim
