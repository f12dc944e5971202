// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "trident_sim/samples/radio_samples.h"

namespace trident::sim {

/// Bytes of a packet's topic and data together, at most.
constexpr std::size_t kMaxPacketBytes = 10000;

/// A packet's topic, qos, id and data as the bytes that go over the air. Throws Error when they are
/// too many.
std::string encode_packet(const RadioPacketSample& packet);

/// Fills those fields of a packet. Bytes that are no packet, as a user without ROS sends them, are
/// its data.
void decode_packet(const std::string& bytes, RadioPacketSample* packet);

}  // namespace trident::sim
