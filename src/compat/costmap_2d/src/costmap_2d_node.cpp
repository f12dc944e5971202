// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <costmap_2d/VoxelGrid.h>

#include "trident_nav_ros/planner_node.h"

int main(int argc, char** argv) {
  return trident::nav::costmap_main(argc, argv,
                                    trident::nav::voxel_advertiser<costmap_2d::VoxelGrid>());
}
