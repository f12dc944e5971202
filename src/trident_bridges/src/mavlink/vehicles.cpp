// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/vehicles.h"

#include <map>
#include <utility>

#include "trident_base/error.h"

namespace trident::bridges::mavlink {
namespace {

constexpr int kMaxSystemId = 254;  // 255 is the ground station's

/// A given number, or `first` + `step` i. Throws Error beyond `limit`.
int numbered(std::optional<int> given, int first, int step, std::size_t i, int limit,
             const std::string& vehicle, const char* what) {
  const int number = given ? *given : first + step * static_cast<int>(i);
  if (number > limit) {
    throw Error("vehicle '" + vehicle + "': " + what + " " + std::to_string(number) +
                ", legal: up to " + std::to_string(limit));
  }
  return number;
}

/// Topic of what the vehicle believes, or of the truth, as the shipped descriptions have them.
std::string odometry_topic(const VehicleEntry& entry) {
  const bool flies = entry.kind != VehicleKind::kRover && entry.kind != VehicleKind::kBoat;
  if (entry.truth) return flies ? "ground_truth/odometry" : "ground_truth/odom";
  if (entry.odometry) return *entry.odometry;
  if (flies) return "odometry_sensor1/odometry";
  return entry.kind == VehicleKind::kRover ? "odom" : "odometry";
}

/// What may be had once: reports who has it already.
class Claims {
 public:
  /// Throws Error when another one has claimed the same.
  void claim(const std::string& what, const std::string& who) {
    const auto [it, is_new] = owners_.emplace(what, who);
    if (!is_new) throw Error("'" + it->second + "' and '" + who + "' both have " + what);
  }

 private:
  std::map<std::string, std::string> owners_;
};

}  // namespace

std::vector<VehicleLinks> resolve(const VehiclesFile& file) {
  std::vector<VehicleLinks> all;
  for (std::size_t i = 0; i < file.vehicles.size(); ++i) {
    const VehicleEntry& entry = file.vehicles[i];
    const auto port = [&](std::optional<std::uint16_t> given, int first, int step) {
      return static_cast<std::uint16_t>(
          numbered(given, first, step, i, 65535, entry.vehicle, "port"));
    };
    VehicleLinks links;
    links.vehicle = entry.vehicle;
    links.ros_namespace = entry.ros_namespace.value_or(entry.vehicle);
    links.odometry = odometry_topic(entry);
    links.max_thrust_N = entry.max_thrust_N;
    links.kind = entry.kind;
    links.autopilot = entry.autopilot;
    links.system_id = static_cast<std::uint8_t>(
        numbered(entry.system_id, 1, 1, i, kMaxSystemId, entry.vehicle, "system id"));
    links.offboard_port = port(entry.offboard_port, 14580, 1);
    links.offboard_remote_port = port(entry.offboard_remote_port, 14540, 1);
    links.gcs_port = port(entry.gcs_port, 18570, 1);
    links.tcp_port = port(entry.tcp_port, 5760, 10);
    links.px4_simulator_port = port(entry.px4_simulator_port, 4560, 1);
    links.ardupilot_json_port = port(entry.ardupilot_json_port, 9002, 10);
    links.accept_mavlink1 = entry.accept_mavlink1;
    links.signing_key_file = entry.signing_key_file.value_or("");
    all.push_back(std::move(links));
  }
  return all;
}

void VehiclesFile::validate() const {
  Claims claims;
  const auto udp = [&](std::uint16_t port, const std::string& who) {
    claims.claim("UDP port " + std::to_string(port), who);
  };
  const auto tcp = [&](std::uint16_t port, const std::string& who) {
    claims.claim("TCP port " + std::to_string(port), who);
  };
  udp(gcs_remote_port, "the ground station");
  tcp(router_port, "the router");
  for (const VehicleLinks& links : resolve(*this)) {
    claims.claim("the name " + links.vehicle, links.vehicle);
    claims.claim("namespace " + links.ros_namespace, links.vehicle);
    claims.claim("system id " + std::to_string(links.system_id), links.vehicle);
    udp(links.offboard_port, links.vehicle);
    udp(links.offboard_remote_port, links.vehicle);
    udp(links.gcs_port, links.vehicle);
    udp(links.ardupilot_json_port, links.vehicle);
    tcp(links.tcp_port, links.vehicle);
    tcp(links.px4_simulator_port, links.vehicle);
  }
}

}  // namespace trident::bridges::mavlink
