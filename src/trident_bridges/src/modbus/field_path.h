// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trident_bridges/modbus/message_fields.h"

namespace trident::bridges::modbus {

/// Whether a step leads to all elements of an array.
bool is_whole_array(const PathStep& step, const MessageField& field);

/// The field that a path leads to. Throws Error for a path that leads to no number, array of
/// numbers or text.
MessageField target_of(const MessageDefinition& definition, const std::vector<PathStep>& steps);

}  // namespace trident::bridges::modbus
