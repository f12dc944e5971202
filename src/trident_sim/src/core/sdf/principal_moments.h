// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>

namespace trident::sim {

/// What is wrong with the principal moments of a positive definite inertia [kg m^2], or "": of a
/// body none is larger than the sum of the others. Published vehicles, whose moments were measured
/// or estimated one by one, are beyond it by up to 21 %; what is reported is beyond 50 %, which no
/// measurement explains, but a slipped digit or a unit does.
std::string uneven_moments(const Eigen::Matrix3d& inertia);

/// What is done with such an inertia.
inline constexpr char kUsedAsItIs[] = "used as it is, as in Gazebo";

}  // namespace trident::sim
