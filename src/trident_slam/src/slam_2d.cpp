// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/slam_2d.h"

namespace trident {

void register_builtin_slam_2d(Registry<Slam2dFactory>& registry) {
  (void)registry;  // one line per algorithm
}

}  // namespace trident
