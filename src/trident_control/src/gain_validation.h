// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>

namespace trident::control {

/// Throws trident::Error unless all three are finite and >= 0; names `name`/x, /y or /z.
void validate_gain(const std::string& name, const Eigen::Vector3d& gain);

}  // namespace trident::control
