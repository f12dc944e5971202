// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/mavros_params.h"
#include "trident_ros/node_params.h"

namespace trident::mavros {

/// Which vehicles a process has.
struct VehicleListParams {
  std::vector<std::string> vehicles;  ///< namespaces; empty: one, that of the node

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field(
        "vehicles", vehicles,
        "namespaces of several vehicles: uav1 of /mavros is /uav1/mavros; [] is the node alone");
  }
};

/// One vehicle of a process.
struct VehicleParams {
  std::string name;     ///< absolute, as if it were a node: /uav1/mavros
  MavrosParams params;  ///< its own
};

/// The parameters below an absolute name.
using FetchParams = std::function<ros_utils::NodeParams(const std::string& name)>;

/// The vehicles of a node: itself, or for each name of ~vehicles that namespace; uav1 of /mavros is
/// /uav1/mavros. Parameters of the node hold for all vehicles, those below a vehicle's name for it
/// alone. Logs what is left out or unknown. Throws ConfigError as read_mavros_params() does, and
/// Error naming both vehicles of which one has the name, the frames or the port of the other.
std::vector<VehicleParams> read_vehicles(ros_utils::NodeParams& node, const FetchParams& fetch);

/// Why two vehicles cannot be in one process; empty: all can.
std::string clash_of(const std::vector<VehicleParams>& vehicles);

}  // namespace trident::mavros
