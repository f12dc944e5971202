// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/conversions.h"

namespace trident::mavros {

/// Fills what OPTICAL_FLOW_RAD, HIL_OPTICAL_FLOW and mavros_msgs/OpticalFlowRad have in common, all
/// but time and frame: turns about the axes of the body [rad], FRD in MAVLink, FLU in ROS.
template <class From, class To>
void copy_flow(const From& from, To& to) {
  using bridges::mavlink::swap_body;
  const Eigen::Vector3d flow = swap_body({from.integrated_x, from.integrated_y, 0.0});
  const Eigen::Vector3d turn =
      swap_body({from.integrated_xgyro, from.integrated_ygyro, from.integrated_zgyro});
  to.integration_time_us = from.integration_time_us;
  to.integrated_x = static_cast<float>(flow.x());
  to.integrated_y = static_cast<float>(flow.y());
  to.integrated_xgyro = static_cast<float>(turn.x());
  to.integrated_ygyro = static_cast<float>(turn.y());
  to.integrated_zgyro = static_cast<float>(turn.z());
  to.temperature = from.temperature;
  to.quality = from.quality;
  to.time_delta_distance_us = from.time_delta_distance_us;
  to.distance = from.distance;
}

}  // namespace trident::mavros
