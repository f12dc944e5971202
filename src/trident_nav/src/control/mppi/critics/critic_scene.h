// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "critic.h"

namespace trident::nav {

/// What critics need of a situation; `furthest` is still 0. `grid` has distances.
CriticScene make_critic_scene(const MppiModel& model, const Situation& situation,
                              const CostGrid& grid);

/// The point of the path that is nearest to an end of a trajectory without contact, at most; and
/// the share of the path's points up to there at which the inscribed circle has no room.
void find_furthest(const Rollouts& rollouts, CriticScene* scene);

}  // namespace trident::nav
