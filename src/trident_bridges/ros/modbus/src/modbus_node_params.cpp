// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/modbus/modbus_node_params.h"

namespace trident::bridges::modbus {

RegisterMap ModbusNodeParams::load() const {
  RegisterMap result = load_register_map(map);
  TransportSpec& transport = result.spec.transport;
  transport.host = host.value_or(transport.host);
  transport.port = port.value_or(transport.port);
  transport.device = device.value_or(transport.device);
  result.spec.unit = unit.value_or(result.spec.unit);
  return result;
}

LinkOptions ModbusNodeParams::link() const {
  return {allow_remote, static_cast<std::uint32_t>(max_clients)};
}

}  // namespace trident::bridges::modbus
