// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Prints who speaks MAVLink where: mavlink_vehicles FILE. A file that is not legal is one error.
#include <cstdio>
#include <exception>
#include <string>

#include "trident_bridges/mavlink/vehicles.h"

namespace trident::bridges::mavlink {
namespace {

template <class Enum>
const char* name_of(Enum value) {
  for (const auto& entry : enum_names(Enum{})) {
    if (entry.value == value) return entry.name;
  }
  return "";
}

void print(const std::string& path) {
  const auto file = load_yaml<VehiclesFile>(path);
  std::printf("%-14s %-14s %-10s %-10s %3s %21s %6s %6s %6s %6s %s\n", "vehicle", "namespace",
              "kind", "autopilot", "id", "offboard UDP", "GCS", "TCP", "PX4", "JSON", "signed");
  for (const VehicleLinks& links : resolve(file)) {
    const std::string offboard =
        std::to_string(links.offboard_port) + " to " + std::to_string(links.offboard_remote_port);
    std::printf("%-14s %-14s %-10s %-10s %3d %21s %6d %6d %6d %6d %s\n", links.vehicle.c_str(),
                links.ros_namespace.c_str(), name_of(links.kind), name_of(links.autopilot),
                int{links.system_id}, offboard.c_str(), int{links.gcs_port}, int{links.tcp_port},
                int{links.px4_simulator_port}, int{links.ardupilot_json_port},
                links.signing_key_file.empty() ? "no" : links.signing_key_file.c_str());
  }
  std::printf("ground stations: UDP %d; router of all vehicles: TCP %d\n",
              int{file.gcs_remote_port}, int{file.router_port});
}

}  // namespace
}  // namespace trident::bridges::mavlink

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: mavlink_vehicles FILE\n");
    return 2;
  }
  try {
    trident::bridges::mavlink::print(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mavlink_vehicles: %s\n", error.what());
    return 1;
  }
}
