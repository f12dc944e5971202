// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "trident_base/config_node.h"
#include "trident_bridges/modbus/message_definition.h"
#include "trident_bridges/modbus/register_map.h"

namespace trident::bridges::modbus {

/// Which end of a link a node is: the device, or the one that asks it.
enum class Role { kServer, kClient };

/// A value, or one bit of it, and the field of the topic that it goes to or comes from.
struct TopicBinding {
  static constexpr int kWhole = -1;  ///< as `bit`: the value

  std::size_t entry = 0;  ///< number in RegisterMap::entries
  int bit = kWhole;       ///< of a value of type bits, whose bits are topics of their own
  std::string topic;      ///< relative to the node
  std::string message;    ///< package/Type
  std::string field;      ///< path
};

/// The topics of a map, seen from one end. A device takes what can be read from topics, and
/// publishes what is written; a client does the reverse. A value that is read_write has its command
/// on its topic, and its state on `topic`/state. Bits are topics `topic`/NAME, unless the message
/// is another than std_msgs/Bool, which then takes the register as a whole.
struct TopicBindings {
  std::vector<TopicBinding> inputs;   ///< topics that the node subscribes
  std::vector<TopicBinding> outputs;  ///< topics that the node publishes
};

/// See TopicBindings.
TopicBindings topic_bindings(const RegisterMap& map, Role role);

/// Finds the definition of a message type; throws Error for an unknown one.
using DefinitionSource = std::function<const MessageDefinition&(const std::string& type)>;

/// What is wrong with the topics of a map: types that are not known, fields that they do not have
/// or that do not fit the value, topics of two types.
std::vector<ConfigError> errors_of_topics(const RegisterMap& map, const DefinitionSource& source);

}  // namespace trident::bridges::modbus
