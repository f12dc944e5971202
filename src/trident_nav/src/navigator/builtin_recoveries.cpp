// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "recoveries.h"

namespace trident::nav {

RecoveryRegistry builtin_recoveries() {
  RecoveryRegistry registry("recovery behavior");
  add_clear_costmap(registry);
  add_move_slow(registry);
  add_rotate(registry);
  add_retreat(registry);
  return registry;
}

}  // namespace trident::nav
