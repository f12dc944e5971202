// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <trident_msgs/LinkStatusArray.h>
#include <trident_msgs/RadioPacket.h>

#include "trident_sim/samples/radio_samples.h"

namespace trident::sim {

// Sample -> message. The message is reused from call to call.
void convert(const RadioPacketSample& sample, trident_msgs::RadioPacket& message);
void convert(const LinkStatusArraySample& sample, trident_msgs::LinkStatusArray& message);

/// Message -> sample.
RadioPacketSample from_packet(const trident_msgs::RadioPacket& message);

}  // namespace trident::sim
