// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace trident::sim {

struct Link;

/// Velocity of a link's own frame origin, world axes [m/s].
Eigen::Vector3d link_velocity_world(const Link& link);
/// Acceleration of a link's own frame origin over the last step of `dt_s`, world axes [m/s^2]; zero
/// for a static link. Gravity is not part of it.
Eigen::Vector3d link_acceleration_world(const Link& link, double dt_s);

}  // namespace trident::sim
