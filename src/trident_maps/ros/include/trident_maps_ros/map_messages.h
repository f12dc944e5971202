// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/Pose.h>
#include <nav_msgs/OccupancyGrid.h>

#include "trident_base/occupancy_grid.h"
#include "trident_base/se2.h"

namespace trident::maps {

/// At height 0, turned about z.
geometry_msgs::Pose to_pose_message(const SE2& T_parent_child);

/// The heading of the body's x axis; throws Error when a number is not finite or the quaternion is
/// not of length one within 1 %.
SE2 from_pose_message(const geometry_msgs::Pose& pose);

/// Header as given; `map_load_time` is its stamp.
nav_msgs::OccupancyGrid to_map_message(const OccupancyGrid& grid, const std_msgs::Header& header);

/// Throws Error when the number of cells is not width x height, or the resolution is not > 0.
OccupancyGrid from_map_message(const nav_msgs::OccupancyGrid& message);

}  // namespace trident::maps
