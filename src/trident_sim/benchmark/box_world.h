// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trident_sim/world.h"

namespace trident::sim {

/// What the benchmarks of rays and their sensors look at.

/// One link of one collision.
ModelSpec make_model(const std::string& name, const Shape& shape, const SE3& T_world_model,
                     bool is_static);
/// The plane z = 0, and sixty boxes of 0.4 to 2 m within 20 m around the origin, which stands free.
void add_boxes(World& world, bool is_static);

/// CPU time of the calling thread [s].
double thread_cpu_s();

}  // namespace trident::sim
