// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trident_bridges/modbus/client.h"
#include "trident_bridges_ros/modbus/device_connection.h"
#include "trident_bridges_ros/modbus/modbus_node.h"

namespace trident::bridges::modbus {

/// A client of a PLC: what it reads is published, and topics become what it writes.
class ModbusClientNode : public ModbusNode {
 public:
  /// Connects, and again whenever the device is gone. Throws ConfigError for a wrong map.
  ModbusClientNode(ros::NodeHandle& node, NodePollLoop& loop, const ModbusNodeParams& params);

 protected:
  void on_frame(const LinkFrame& frame) override;
  void on_joined(PeerId peer) override;
  void on_left(PeerId peer) override;
  void on_topic(std::size_t entry, const Value& value) override;
  std::string problem() const override;
  Rows counts() const override;

 private:
  Client client_;
  DeviceConnection device_;
  NodeTicker ticker_;
};

}  // namespace trident::bridges::modbus
