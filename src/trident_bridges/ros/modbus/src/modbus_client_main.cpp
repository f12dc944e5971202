// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/modbus/modbus_client_node.h"
#include "trident_bridges_ros/modbus/node_main.h"

int main(int argc, char** argv) {
  using namespace trident::bridges::modbus;
  return run_modbus_node<ModbusClientNode>(argc, argv, "modbus_client_node");
}
