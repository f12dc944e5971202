// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_nav/navigator/recovery.h"

namespace trident::nav {

void add_clear_costmap(RecoveryRegistry& registry);
void add_move_slow(RecoveryRegistry& registry);
void add_rotate(RecoveryRegistry& registry);
void add_retreat(RecoveryRegistry& registry);

}  // namespace trident::nav
