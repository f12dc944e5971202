// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trident_base/yaml_config.h"

namespace trident::bridges::mavlink {

/// What moves a vehicle: decides MAV_TYPE.
enum class VehicleKind : std::uint8_t { kQuadrotor, kHexarotor, kRover, kBoat };
/// Names in files.
constexpr auto enum_names(VehicleKind) {
  return std::array{EnumName{VehicleKind::kQuadrotor, "quadrotor"},
                    EnumName{VehicleKind::kHexarotor, "hexarotor"},
                    EnumName{VehicleKind::kRover, "rover"}, EnumName{VehicleKind::kBoat, "boat"}};
}

/// Whose modes, parameters and habits a vehicle has.
enum class AutopilotFlavour : std::uint8_t { kPx4, kArdupilot };
/// Names in files.
constexpr auto enum_names(AutopilotFlavour) {
  return std::array{EnumName{AutopilotFlavour::kPx4, "px4"},
                    EnumName{AutopilotFlavour::kArdupilot, "ardupilot"}};
}

/// Ports that others than this computer use begin here; those below need root.
inline constexpr Range kLegalPorts{1024.0, 65535.0};

/// One vehicle of config/bridges/vehicles.yaml. With i, its place in the list from 0: what is not
/// given follows from i as PX4 and ArduPilot number their simulated vehicles.
struct VehicleEntry {
  std::string vehicle;                                  ///< name of the model in the world
  std::optional<std::string> ros_namespace;             ///< of its topics; its name
  bool truth = false;                                   ///< fly by the truth, no estimate
  std::optional<std::string> odometry;                  ///< topic of the estimator; by kind
  VehicleKind kind = VehicleKind::kQuadrotor;           ///< what moves it
  AutopilotFlavour autopilot = AutopilotFlavour::kPx4;  ///< its modes and parameters
  std::optional<std::uint8_t> system_id;                ///< 1 + i
  std::optional<std::uint16_t> offboard_port;           ///< UDP, local: 14580 + i
  std::optional<std::uint16_t> offboard_remote_port;    ///< UDP, where it sends: 14540 + i
  std::optional<std::uint16_t> gcs_port;                ///< UDP, local: 18570 + i
  std::optional<std::uint16_t> tcp_port;                ///< TCP server: 5760 + 10 i
  std::optional<std::uint16_t> px4_simulator_port;      ///< TCP server: 4560 + i
  std::optional<std::uint16_t> ardupilot_json_port;     ///< UDP, local: 9002 + 10 i
  double max_thrust_N = 24.0;                           ///< of all rotors; of the iris
  bool accept_mavlink1 = false;                         ///< understand MAVLink 1, too
  std::optional<std::string> signing_key_file;          ///< sign and ask for signatures

  /// Lists the fields: see yaml_config.h.
  template <class Archive>
  void visit(Archive& ar) {
    ar.required("vehicle", vehicle, "name of the model in the world");
    ar.field("namespace", ros_namespace, "of its topics; default: its name");
    ar.field("truth", truth, "steer by ground_truth/..., not by what the vehicle can know");
    ar.field("odometry", odometry,
             "topic of its estimate; default: odometry_sensor1/odometry, odom, odometry by kind");
    ar.field("max_thrust", max_thrust_N, Range{0.1, 1e5},
             "of all rotors together, what a thrust of 1 means [N]");
    ar.field("kind", kind, "what moves it");
    ar.field("autopilot", autopilot, "whose modes, parameters and habits it has");
    ar.field("system_id", system_id, Range{1, 254}, "of MAVLink; default: 1 + i");
    ar.field("offboard_port", offboard_port, kLegalPorts, "UDP, local; default: 14580 + i");
    ar.field("offboard_remote_port", offboard_remote_port, kLegalPorts,
             "UDP, where it sends to; default: 14540 + i");
    ar.field("gcs_port", gcs_port, kLegalPorts, "UDP, local; default: 18570 + i");
    ar.field("tcp_port", tcp_port, kLegalPorts, "TCP server; default: 5760 + 10 i");
    ar.field("px4_simulator_port", px4_simulator_port, kLegalPorts,
             "TCP server for an external PX4; default: 4560 + i");
    ar.field("ardupilot_json_port", ardupilot_json_port, kLegalPorts,
             "UDP, local, for an external ArduPilot; default: 9002 + 10 i");
    ar.field("accept_mavlink1", accept_mavlink1, "understand MAVLink 1, which cannot be signed");
    ar.field("signing_key_file", signing_key_file,
             "64 hexadecimal digits in a file of mode 600: sign, and refuse what is not signed");
  }
};

/// config/bridges/vehicles.yaml: which vehicles speak MAVLink, and where.
struct VehiclesFile {
  std::vector<VehicleEntry> vehicles;     ///< in the order that numbers them
  std::uint16_t gcs_remote_port = 14550;  ///< UDP, where all vehicles look for a ground station
  std::uint16_t router_port = 14445;      ///< TCP server that carries all vehicles

  /// Lists the fields: see yaml_config.h.
  template <class Archive>
  void visit(Archive& ar) {
    ar.required("vehicles", vehicles, "one entry for each; i is its place, from 0");
    ar.field("gcs_remote_port", gcs_remote_port, kLegalPorts,
             "UDP, where all vehicles look for a ground station");
    ar.field("router_port", router_port, kLegalPorts, "TCP server that carries all vehicles");
  }
  /// Throws Error when two vehicles have the same name, namespace, system id or port; names both.
  void validate() const;
};

/// A vehicle with all that follows from its place.
struct VehicleLinks {
  std::string vehicle;                 ///< see VehicleEntry
  std::string ros_namespace;           ///< see VehicleEntry
  std::string odometry;                ///< see VehicleEntry; of the truth, if it flies by that
  double max_thrust_N;                 ///< see VehicleEntry
  VehicleKind kind;                    ///< see VehicleEntry
  AutopilotFlavour autopilot;          ///< see VehicleEntry
  std::uint8_t system_id;              ///< see VehicleEntry
  std::uint16_t offboard_port;         ///< see VehicleEntry
  std::uint16_t offboard_remote_port;  ///< see VehicleEntry
  std::uint16_t gcs_port;              ///< see VehicleEntry
  std::uint16_t tcp_port;              ///< see VehicleEntry
  std::uint16_t px4_simulator_port;    ///< see VehicleEntry
  std::uint16_t ardupilot_json_port;   ///< see VehicleEntry
  bool accept_mavlink1;                ///< see VehicleEntry
  std::string signing_key_file;        ///< empty: nothing is signed
};

/// All vehicles of a file. Throws Error when a number does not fit any more: too many vehicles.
std::vector<VehicleLinks> resolve(const VehiclesFile& file);

}  // namespace trident::bridges::mavlink
