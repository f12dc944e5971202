// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/autopilot/vehicle.h"

#include <cmath>

namespace trident::bridges {

double VehicleState::yaw() const {
  const Eigen::Vector3d ahead = R_world_body * Eigen::Vector3d::UnitX();
  return std::atan2(ahead.y(), ahead.x());
}

}  // namespace trident::bridges
