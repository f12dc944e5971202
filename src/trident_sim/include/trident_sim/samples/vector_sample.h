// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>

#include "trident_base/sim_time.h"

namespace trident::sim {

/// A vector in frame, of a quantity that the port's plugin names (geometry_msgs/Vector3Stamped).
struct VectorSample {
  SimTime stamp;                                    ///< of the state that was measured
  std::string frame;                                ///< whose axes the vector is expressed in
  Eigen::Vector3d value = Eigen::Vector3d::Zero();  ///< in the unit that the plugin documents
};

}  // namespace trident::sim
