// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "program.h"
#include "trident_trajectories/optimize.h"

namespace trident::trajectories {

/// The x from which an optimizer begins; `seed` is for Start::kRandom. Not for kPriorities, which
/// takes an optimizer itself.
std::vector<double> start_of(Start start, Program& program, const SplineBasis& basis,
                             std::uint64_t seed);

/// "swirl_left" and so on.
const char* name_of(Start start);

}  // namespace trident::trajectories
