// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <memory>
#include <string>
#include <vector>

#include "trident_bridges/modbus/message_fields.h"
#include "trident_bridges/modbus/register_map.h"
#include "trident_bridges/modbus/topic_bindings.h"
#include "trident_bridges_ros/modbus/message_lookup.h"
#include "trident_ros/direct_publication.h"

namespace trident::bridges::modbus {

/// The topics that a node publishes by a map: values of one topic make one message of any type,
/// whose other fields are zero. Who subscribes later gets the newest message.
class TopicOutputs {
 public:
  /// Advertises the topics below `node`'s namespace. Throws Error for a type or a field that there
  /// is not, or for topics with two types.
  TopicOutputs(ros::NodeHandle& node, const RegisterMap& map,
               const std::vector<TopicBinding>& bindings, MessageLookup& lookup);
  ~TopicOutputs();

  /// Sets the value of an entry; its topics are due.
  void set(std::size_t entry, const Value& value);
  /// Publishes the topics that are due.
  void publish();
  /// Sends the newest messages to those who have subscribed since.
  void serve_late_subscribers();

 private:
  class Topic;
  /// Where the value of an entry goes.
  struct Target {
    Topic* topic = nullptr;
    std::size_t field = 0;
    int bit = TopicBinding::kWhole;
  };

  std::vector<std::unique_ptr<Topic>> topics_;
  std::vector<std::vector<Target>> targets_;  ///< of each entry
};

}  // namespace trident::bridges::modbus
