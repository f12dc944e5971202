// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "trident_bridges/modbus/message_definition.h"

namespace trident::bridges::modbus {

/// Definitions of message types, from the msg folders of the ROS packages that rospack finds.
class MessageLookup {
 public:
  /// The definition of "package/Type" with those of the types in it. Throws Error for an unknown
  /// package or type, with the nearest type of the package. The result lives as long as the lookup.
  const MessageDefinition& get(const std::string& type);

 private:
  std::map<std::string, MessageDefinition> known_;
};

}  // namespace trident::bridges::modbus
