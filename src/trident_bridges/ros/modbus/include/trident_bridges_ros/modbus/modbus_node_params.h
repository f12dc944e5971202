// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "trident_base/config_types.h"
#include "trident_bridges/modbus/register_map.h"
#include "trident_bridges_ros/modbus/modbus_link.h"

namespace trident::bridges::modbus {

/// Parameters of modbus_server_node and modbus_client_node, in addition to those of the map.
struct ModbusNodeParams {
  std::string map;                    ///< file
  std::optional<std::string> host;    ///< in place of the map's
  std::optional<std::uint16_t> port;  ///< in place of the map's
  std::optional<std::string> device;  ///< in place of the map's
  std::optional<int> unit;            ///< in place of the map's
  bool allow_remote = false;
  int max_clients = 64;

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.required("map", map, "map file, see docs/howto/modbus.md");
    ar.field("host", host, "in place of the map's, of tcp");
    ar.field("port", port, Range{0, 65535},
             "in place of the map's, of tcp; a server takes 0: a free one");
    ar.field("device", device, "in place of the map's, of rtu");
    ar.field("unit", unit, Range{1, 247}, "in place of the map's");
    ar.field("allow_remote", allow_remote, "may bind or connect to what is not loopback");
    ar.field("max_clients", max_clients, Range{1, 20'000}, "of a TCP server; more are refused");
  }

  /// The map with what these parameters replace. Throws ConfigError as load_register_map() does.
  RegisterMap load() const;
  /// For the link.
  LinkOptions link() const;
};

}  // namespace trident::bridges::modbus
