// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pose_system.h"
#include "trident_slam/pose_graph_optimizer.h"

namespace trident::slam {

/// Poses that need no start: first the rotations that agree best with those of the edges, as
/// unconstrained matrices that are then made orthogonal (Martinec, Pajdla 2007; Carlone et al.
/// 2015), then the positions that agree best with these rotations. Two linear systems. Held
/// vertices stay. Empty when a system cannot be solved, as where edges carry no information.
template <class Group>
typename PoseSystem<Group>::Poses chordal_start(const PoseSystem<Group>& system);

/// Moves the system's poses to where the optimisation is to start, and notes that in the report.
template <class Group>
void apply_start(PoseSystem<Group>& system, PoseGraphStart start, PoseGraphReport& report);

}  // namespace trident::slam
