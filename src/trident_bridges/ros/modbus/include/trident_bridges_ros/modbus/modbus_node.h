// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "trident_bridges/modbus/register_map.h"
#include "trident_bridges/modbus/topic_bindings.h"
#include "trident_bridges_ros/modbus/message_lookup.h"
#include "trident_bridges_ros/modbus/modbus_link.h"
#include "trident_bridges_ros/modbus/modbus_node_params.h"
#include "trident_bridges_ros/modbus/node_ticker.h"
#include "trident_bridges_ros/modbus/topic_inputs.h"
#include "trident_bridges_ros/modbus/topic_outputs.h"
#include "trident_bridges_ros/node_poll_loop.h"
#include "trident_ros/refusals.h"

namespace trident::bridges::modbus {

/// What both ends of a Modbus link are as a node: a map, its topics, a link, and /diagnostics with
/// what was refused, by kind, and a status "NAME: modbus" once a second.
class ModbusNode {
 public:
  ModbusNode(const ModbusNode&) = delete;
  ModbusNode& operator=(const ModbusNode&) = delete;

 protected:
  /// Rows of the status: a name and a value each.
  using Rows = std::vector<std::pair<std::string, std::string>>;

  /// Checks the map's topics, and advertises those that it publishes. `loop` outlives the node.
  /// Throws ConfigError.
  ModbusNode(ros::NodeHandle& node, NodePollLoop& loop, const ModbusNodeParams& params, Role role);
  virtual ~ModbusNode();

  /// Opens the link and subscribes, once the derived node is ready for what comes.
  void open(ros::NodeHandle& node, const ModbusNodeParams& params);
  void note(const std::string& kind, const std::string& text) { refusals_.note(kind, text); }

  /// A frame has come.
  virtual void on_frame(const LinkFrame& frame) = 0;
  /// A peer has come, or is gone.
  virtual void on_joined(PeerId peer) = 0;
  virtual void on_left(PeerId peer) = 0;
  /// A topic has a value for an entry.
  virtual void on_topic(std::size_t entry, const Value& value) = 0;
  /// What the status says; "" is well.
  virtual std::string problem() const = 0;
  virtual Rows counts() const = 0;

  NodePollLoop& loop_;
  Role role_;
  RegisterMap map_;
  MessageLookup lookup_;
  std::unique_ptr<TopicOutputs> outputs_;
  std::unique_ptr<ModbusLink> link_;

 private:
  void look_around();
  void publish_status();

  ros_utils::Refusals refusals_;
  ros::Publisher diagnostics_;
  std::unique_ptr<TopicInputs> inputs_;
  std::uint64_t call_ = 0;
  int looks_ = 0;
};

}  // namespace trident::bridges::modbus
