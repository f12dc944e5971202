// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trident_sim/model_spec.h"

namespace trident::sim {

/// Checks the values of `<physics>`. Throws Error at the first that is illegal, or, where `odd` is
/// given, puts Gazebo's default in its place and adds a sentence to `odd`.
void validate(PhysicsSpec& physics, std::vector<std::string>* odd = nullptr);

}  // namespace trident::sim
