// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation_ros/amcl_node.h"

int main(int argc, char** argv) { return trident::estimation::amcl_main(argc, argv); }
