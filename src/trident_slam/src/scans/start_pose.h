// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "trident_base/se2.h"

namespace trident::slam {

/// Throws Error unless a map can continue from a pose: the grids about it reach from there to what
/// is mapped, `mapped` [m], so that a pose far away would need more memory than there is.
void check_start_pose(const SE2& T_map_base, const Eigen::AlignedBox2d& mapped);

}  // namespace trident::slam
