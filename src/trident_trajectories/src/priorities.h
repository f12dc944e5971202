// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "trident_trajectories/optimize.h"

namespace trident::trajectories {

/// The x of a team whose robots are planned one after another, in their order, each clear of those
/// before it. What binds robots together (places, orders) is left to who begins with it.
std::vector<double> priorities_start(const Problem& problem,
                                     const std::shared_ptr<const SplineBasis>& basis,
                                     const OptimizeOptions& options);

}  // namespace trident::trajectories
