// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_maps_ros/map_server_node.h"

int main(int argc, char** argv) { return trident::maps::map_server_main(argc, argv); }
