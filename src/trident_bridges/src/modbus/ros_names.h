// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace trident::bridges::modbus {

/// Letters, digits and underscores, begun by a letter.
bool is_name(const std::string& text);

/// Names with slashes between them, as ROS has them.
bool is_topic(const std::string& text);

/// "package/Type".
bool is_message_type(const std::string& text);

}  // namespace trident::bridges::modbus
