// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "trident_bridges/modbus/message_definition.h"
#include "trident_bridges/modbus/value.h"

namespace trident::bridges::modbus {

/// Up to eight bytes as ROS 1 serializes them, least significant first, as one number.
std::uint64_t scalar_bits(Bytes bytes);
/// A scalar of a message; `bytes` are wire_size() of its type, which is not kString or kMessage.
Number read_scalar(WireType type, Bytes bytes);
/// Appends a scalar; a number that the type does not have becomes the nearest one, NaN of an
/// integer 0.
void write_scalar(WireType type, const Number& number, std::vector<std::uint8_t>& out);

}  // namespace trident::bridges::modbus
