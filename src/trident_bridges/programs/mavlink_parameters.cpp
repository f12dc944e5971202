// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Prints the parameters of a simulated vehicle: mavlink_parameters [px4|ardupilot [uav|ugv|usv]].
// Without words those of all vehicles that differ.
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_bridges/autopilot/parameter_table.h"

namespace trident::bridges {
namespace {

struct Table {
  const char* flavor_name;
  const char* vehicle_name;
  Flavor flavor;
  VehicleClass vehicle;
};

constexpr Table kTables[] = {
    {"px4", "uav", Flavor::kPx4, VehicleClass::kMultirotor},
    {"px4", "ugv", Flavor::kPx4, VehicleClass::kGround},
    {"px4", "usv", Flavor::kPx4, VehicleClass::kVessel},
    {"ardupilot", "uav", Flavor::kArduPilot, VehicleClass::kMultirotor},
    {"ardupilot", "ugv", Flavor::kArduPilot, VehicleClass::kGround},
    {"ardupilot", "usv", Flavor::kArduPilot, VehicleClass::kVessel},
};

void print(const Table& table) {
  std::printf("%s %s\n", table.flavor_name, table.vehicle_name);
  const ParameterTable parameters(table.flavor, table.vehicle, 1);
  for (const Parameter& one : parameters.all()) {
    const std::string range = number_text(one.min) + " to " + number_text(one.max);
    std::printf("  %-16s %9s  %-16s %-7s %s%s\n", one.name.c_str(), number_text(one.value).c_str(),
                range.c_str(), one.unit.c_str(), one.meaning.c_str(),
                one.is_used ? "" : " (without effect here)");
  }
}

/// Words that are left out fit all.
bool fits(const Table& table, const std::vector<std::string>& words) {
  return (words.empty() || words[0] == table.flavor_name) &&
         (words.size() < 2 || words[1] == table.vehicle_name);
}

void print_matching(const std::vector<std::string>& words) {
  bool has_printed = false;
  for (const Table& table : kTables) {
    if (!fits(table, words)) continue;
    print(table);
    has_printed = true;
  }
  if (!has_printed) {
    throw Error(join(words) + ", legal: px4 or ardupilot, then uav, ugv or usv, or nothing");
  }
}

}  // namespace
}  // namespace trident::bridges

int main(int argc, char** argv) {
  try {
    trident::bridges::print_matching({argv + 1, argv + argc});
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mavlink_parameters: %s\n", error.what());
    return 1;
  }
}
