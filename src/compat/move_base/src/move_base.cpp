// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/move_base_node.h"

#include <costmap_2d/VoxelGrid.h>

int main(int argc, char** argv) {
  return trident::nav::move_base_main(argc, argv,
                                      trident::nav::voxel_advertiser<costmap_2d::VoxelGrid>());
}
