// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// team_fusion_node: one belief about all robots of a team.
#include "trident_estimation_ros/fusion_node.h"

int main(int argc, char** argv) { return trident::estimation::team_fusion_main(argc, argv); }
