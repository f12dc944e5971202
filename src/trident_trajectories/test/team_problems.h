// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trident_trajectories/problem.h"

namespace trident::trajectories {

/// UAVs that change places across a circle of 8 m in 6 s.
Problem antipodal_swap(int robots);

/// A UAV, a unicycle and a vessel that gather where it suits them.
Problem three_platforms();

/// All terms at once: kinds, limits, free durations, a deck, a place, obstacles, an order.
Problem everything();

}  // namespace trident::trajectories
