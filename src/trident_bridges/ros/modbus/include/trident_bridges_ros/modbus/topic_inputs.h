// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "trident_bridges/modbus/message_fields.h"
#include "trident_bridges/modbus/register_map.h"
#include "trident_bridges/modbus/topic_bindings.h"
#include "trident_bridges_ros/modbus/message_lookup.h"
#include "trident_bridges_ros/node_poll_loop.h"

namespace trident::bridges::modbus {

/// What inputs report to their owner, in the loop's thread.
struct InputEvents {
  /// A message has the value of an entry.
  std::function<void(std::size_t entry, const Value& value)> value;
  /// A message is not used: its kind, of a small set, and a sentence.
  std::function<void(const std::string& kind, const std::string& text)> refused;
};

/// The topics that a node subscribes by a map. Messages may be of any type that has the field: its
/// place is found by the definition that the publisher sends, once for each publisher's type.
class TopicInputs {
 public:
  /// Subscribes below `node`'s namespace. `loop`, `map` and `lookup` outlive the inputs.
  TopicInputs(ros::NodeHandle& node, NodePollLoop& loop, const RegisterMap& map,
              const std::vector<TopicBinding>& bindings, MessageLookup& lookup, InputEvents events);
  ~TopicInputs();
  TopicInputs(const TopicInputs&) = delete;
  TopicInputs& operator=(const TopicInputs&) = delete;

  /// Looks whether publishers have come whose type is another one. To be called every second or so.
  void look_at_publishers();
  /// Topics that nobody publishes, in the order of their names.
  std::vector<std::string> silent_topics() const;

 private:
  class Topic;
  /// What all topics share.
  struct Context {
    NodePollLoop& loop;
    const RegisterMap& map;
    MessageLookup& lookup;
    InputEvents events;
    std::vector<std::uint64_t> words;  ///< of entries whose bits are topics of their own
  };

  Context context_;
  std::vector<std::unique_ptr<Topic>> topics_;
};

}  // namespace trident::bridges::modbus
