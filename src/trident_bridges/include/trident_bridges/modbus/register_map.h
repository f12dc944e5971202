// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trident_base/config_node.h"
#include "trident_bridges/modbus/map_spec.h"
#include "trident_bridges/modbus/value.h"

namespace trident::bridges::modbus {

/// One value of a device, checked and complete.
struct RegisterEntry {
  std::string name;       ///< each once in a map
  int line = 0;           ///< of the map file, from 1
  Table table{};          ///< where it lies
  int address = 0;        ///< zero-based, of the first register or bit
  RegisterLayout layout;  ///< in registers; of coils and discrete inputs one bit a value
  double scale = 1.0;     ///< the value is scale times what the registers hold, plus offset
  double offset = 0.0;    ///< see scale
  Access access = Access::kRead;
  std::optional<double> min, max;  ///< of values that are written; empty: what the type has
  std::optional<double> rate;      ///< greatest change per second of simulated time
  std::optional<double> safe;      ///< at start and after `timeout`
  std::optional<double> timeout;   ///< longest silence of the writer [s]
  Value initial;                   ///< until there is another one
  Publish publish = Publish::kChange;
  std::string topic;      ///< empty: has none
  std::string field;      ///< path of the message's field
  std::string message;    ///< "std_msgs/Float64"
  std::string unit, doc;  ///< for tools

  bool is_bit() const { return table == Table::kCoil || table == Table::kDiscrete; }
  bool is_writable() const { return access != Access::kRead; }
  bool is_polled() const { return access != Access::kWrite; }
  /// Addresses that it takes: registers, or bits.
  int addresses() const { return is_bit() ? layout.count : layout.registers(); }
  int end() const { return address + addresses(); }  ///< behind its last address
  /// Whether values are what the registers hold, so that integers of 64 bits pass without loss.
  bool is_unscaled() const { return scale == 1.0 && offset == 0.0; }
  /// "'port_cmd' (holding 100)", for messages.
  std::string label() const;
};

/// Value of registers or bits as on the wire, bits one byte each.
void read_value(const RegisterEntry& entry, Bytes wire, Value& value);
/// The other direction.
Fit write_value(const RegisterEntry& entry, const Value& value, Span<std::uint8_t> wire);
/// "[-1, 1] m/s": legal values of what is written.
std::string range_text(const RegisterEntry& entry);

/// A map file: one device, its values and how it is reached.
struct RegisterMap {
  MapSpec spec;                        ///< all but the registers
  std::string file;                    ///< as errors name it
  std::vector<RegisterEntry> entries;  ///< in the order of the file

  /// Number of an entry; empty for an unknown name.
  std::optional<std::size_t> find(const std::string& name) const;
};

/// Reads a map; throws the first of errors_of_map(), or ConfigError for a file that is no YAML.
RegisterMap load_register_map(const std::string& path);
/// The same of a text; `file_label` stands for the file in errors.
RegisterMap parse_register_map(const std::string& text, const std::string& file_label);

/// All that is wrong with the text of a map: unknown and missing keys, wrong values, names and
/// addresses that are used twice, types that do not fit their table.
std::vector<ConfigError> errors_of_map(const std::string& text, const std::string& file_label);

}  // namespace trident::bridges::modbus
