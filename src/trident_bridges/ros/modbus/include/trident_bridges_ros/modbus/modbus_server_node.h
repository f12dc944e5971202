// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trident_bridges/modbus/server.h"
#include "trident_bridges_ros/modbus/modbus_node.h"

namespace trident::bridges::modbus {

/// A vehicle's PLC: topics fill what clients read, and what they write is published. Limits and
/// silences are of simulated time: a world that stands makes nothing safe.
class ModbusServerNode : public ModbusNode {
 public:
  /// Listens. Throws ConfigError for a wrong map, Error for a port or a device that there is not.
  ModbusServerNode(ros::NodeHandle& node, NodePollLoop& loop, const ModbusNodeParams& params);

 protected:
  void on_frame(const LinkFrame& frame) override;
  void on_joined(PeerId peer) override;
  void on_left(PeerId peer) override;
  void on_topic(std::size_t entry, const Value& value) override;
  std::string problem() const override { return ""; }
  Rows counts() const override;

 private:
  Caller caller_of(PeerId peer) const;

  Server server_;
  std::map<PeerId, Caller> callers_;
  NodeTicker ticker_;
};

}  // namespace trident::bridges::modbus
