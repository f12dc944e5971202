// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/modbus/map_listing.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "trident_base/string_util.h"
#include "trident_bridges/modbus/read_blocks.h"

namespace trident::bridges::modbus {
namespace {

using Row = std::vector<std::string>;

std::string name_of(Table table) {
  return enum_names(Table{})[static_cast<std::size_t>(table)].name;
}

std::string type_text(const RegisterEntry& entry) {
  std::string text = entry.layout.type.text();
  if (entry.layout.count > 1) text += " x " + std::to_string(entry.layout.count);
  if (entry.layout.type.registers() > 1 && entry.layout.words == Order::kLittle) {
    text += " words little";
  }
  if (entry.layout.bytes == Order::kLittle) text += " bytes little";
  return text;
}

std::string scale_text(const RegisterEntry& entry) {
  std::string text;
  if (entry.scale != 1.0) text = number_text(entry.scale);
  if (entry.offset != 0.0) text += (entry.offset > 0 ? "+" : "") + number_text(entry.offset);
  return text;
}

std::string limits_text(const RegisterEntry& entry) {
  Row parts;
  if (entry.min || entry.max) parts.push_back(range_text(entry));
  if (entry.rate) parts.push_back("rate " + number_text(*entry.rate));
  if (entry.safe) parts.push_back("safe " + number_text(*entry.safe));
  if (entry.timeout) parts.push_back("after " + number_text(*entry.timeout) + " s");
  return join(parts);
}

Row row_of(const RegisterEntry& entry) {
  const char* const access = enum_names(Access{})[static_cast<std::size_t>(entry.access)].name;
  const std::string address = std::to_string(entry.address) +
                              (entry.addresses() > 1 ? "-" + std::to_string(entry.end() - 1) : "");
  const std::string topic = entry.topic.empty() ? "" : entry.topic + " " + entry.field;
  return {name_of(entry.table),
          address,
          entry.name,
          type_text(entry),
          scale_text(entry),
          entry.unit,
          access,
          limits_text(entry),
          topic,
          entry.doc};
}

/// The rows with their columns below each other.
std::string aligned(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (widths[i] == 0) continue;
      line += row[i] + std::string(widths[i] - row[i].size() + 2, ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

}  // namespace

std::string map_listing(const RegisterMap& map) {
  std::vector<const RegisterEntry*> sorted;
  for (const RegisterEntry& entry : map.entries) sorted.push_back(&entry);
  std::sort(sorted.begin(), sorted.end(), [](const auto* a, const auto* b) {
    return std::make_pair(a->table, a->address) < std::make_pair(b->table, b->address);
  });
  std::vector<Row> rows{{"table", "address", "name", "type", "scale", "unit", "access", "limits",
                         "topic field", "what"}};
  for (const RegisterEntry* entry : sorted) rows.push_back(row_of(*entry));
  const TransportSpec& transport = map.spec.transport;
  const std::string where =
      transport.kind == TransportKind::kTcp
          ? "tcp " + transport.host + ":" + std::to_string(transport.port)
          : "rtu " + transport.device + " at " + std::to_string(transport.baud) + " baud";
  return map.file + ": unit " + std::to_string(map.spec.unit) + ", " + where + "\n" +
         aligned(rows) + std::to_string(map.entries.size()) + " values; a poll is " +
         std::to_string(read_blocks(map).size()) + " requests\n";
}

}  // namespace trident::bridges::modbus
