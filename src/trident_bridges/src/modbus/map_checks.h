// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trident_base/config_node.h"
#include "trident_bridges/modbus/map_spec.h"
#include "trident_bridges/modbus/register_map.h"

namespace trident::bridges::modbus {

/// Where a register stands in a map file.
struct EntrySource {
  const std::string& file;  ///< as errors name it
  const ConfigNode& item;   ///< what the file says
  std::string path;         ///< "registers[3]"
};

/// A register's entry, with what the file leaves out. Throws ConfigError for what cannot be: an
/// address beyond its table, a type or a limit that does not go with it.
RegisterEntry make_entry(const RegisterSpec& spec, const MapSpec& map, const EntrySource& source);

/// "holding".
std::string table_text(Table table);
/// "addresses 10 to 12", "address 3".
std::string address_text(const RegisterEntry& entry);

}  // namespace trident::bridges::modbus
