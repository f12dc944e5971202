// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>

#include "trident_base/sim_time.h"

namespace trident::sim {

/// A vector in frame, of a quantity that the port's plugin names (geometry_msgs/Vector3Stamped).
struct VectorSample {
  SimTime stamp;
  std::string frame;
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
};

}  // namespace trident::sim
