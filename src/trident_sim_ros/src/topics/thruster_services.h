// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "input_binder.h"

namespace trident::sim {

/// uuv_simulator's services of a thruster, next to the topics of the input `port`: set_ and
/// get_thruster_state, set_ and get_thrust_force_efficiency, set_ and get_dynamic_state_efficiency,
/// get_thruster_conversion_fcn. They answer at once; what was asked for is done in the next step.
/// Returns nullptr if the port is not a thruster's setup.
std::unique_ptr<InputBinding> bind_thruster_services(ros::NodeHandle& node,
                                                     ros::CallbackQueueInterface& queue,
                                                     PortBase& port, const PortBoard& board,
                                                     Repeatability& repeatability);

}  // namespace trident::sim
