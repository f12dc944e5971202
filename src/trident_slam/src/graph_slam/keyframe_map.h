// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "graph_slam/keyframe_graph.h"
#include "trident_base/occupancy_grid.h"

namespace trident {

/// The occupancy map of the keyframes by counting beams that ended in a cell and beams that went
/// through it. A cell is occupied where at least a quarter of at least two beams ended.
OccupancyGrid keyframe_map(const KeyframeGraph& graph, double resolution);

}  // namespace trident
