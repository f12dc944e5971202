// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <std_msgs/Bool.h>
#include <std_msgs/Float64.h>
#include <trident_msgs/EnvironmentState.h>
#include <trident_msgs/WindReading.h>

#include "trident_sim/samples/text_sample.h"
#include "trident_sim/thruster_setup.h"

namespace trident::sim {

// Sample -> message. The message is reused from call to call.
void convert(const EnvironmentSample& sample, trident_msgs::EnvironmentState& message);
void convert(const WindReadingSample& sample, trident_msgs::WindReading& message);
void convert(const NumberSample& sample, std_msgs::Float64& message);
void convert(const FlagSample& sample, std_msgs::Bool& message);

}  // namespace trident::sim
