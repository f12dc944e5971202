// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <functional>
#include <memory>
#include <string>

#include "trident_bridges/mavlink/vehicles.h"
#include "trident_bridges/vehicle/mavlink_vehicle.h"
#include "trident_bridges_ros/mavlink/fleet_router.h"
#include "trident_bridges_ros/mavlink/mavlink_node_params.h"
#include "trident_bridges_ros/mavlink/setpoint_output.h"
#include "trident_bridges_ros/mavlink/vehicle_ports.h"
#include "trident_bridges_ros/mavlink/vehicle_sensors.h"
#include "trident_bridges_ros/node_poll_loop.h"

namespace trident::bridges {

/// What all vehicles of a node share.
struct FleetParts {
  const MavlinkNodeParams& params;
  std::uint16_t gcs_remote_port;
  std::string utc_start;
  NodePollLoop& loop;
  const StaticFrames& frames;
  ros_utils::Refusals& refusals;
  FleetRouter& router;
  /// A client from outside has changed what a vehicle does.
  std::function<void(const std::string& text)> commanded;
};

/// One simulated vehicle between its topics and its ports.
class FleetVehicle {
 public:
  /// Subscribes, advertises and opens its ports. `parts` must outlive it. Throws Error as these do.
  FleetVehicle(const mavlink::VehicleLinks& links, const FleetParts& parts);
  FleetVehicle(const FleetVehicle&) = delete;
  FleetVehicle& operator=(const FleetVehicle&) = delete;

  /// Sends what is due at a time of the world that it need not have moved for.
  void update(SimTime now);
  /// The world waits for its set-points, of which the first one is stamped `start`.
  void begin_lockstep(SimTime start);
  /// Gives the newest set-point again if it may have reached nobody.
  void repeat();

  const std::string& name() const { return name_; }  ///< of its model
  /// Whether the world can wait for it: its set-points have stamps.
  bool is_stamped() const { return output_->is_stamped(); }
  /// Whether its odometry comes and a controller takes its set-points.
  bool is_connected() const { return sensors_->is_connected() && output_->has_reader(); }

 private:
  void receive(const mavlink::Message& message, const std::string& from);
  void send(const mavlink::Message& message);
  void on_moved(SimTime stamp);
  void publish(SimTime stamp);
  mavlink::BothTimes both(SimTime now) const;

  std::string name_;
  const FleetParts& parts_;
  VehicleKey key_;
  std::unique_ptr<SetpointOutput> output_;
  std::unique_ptr<VehicleSensors> sensors_;
  std::unique_ptr<VehiclePorts> ports_;
  std::size_t router_number_ = 0;
  mavlink::MavlinkVehicle vehicle_;
  Setpoint setpoint_;
  struct Times {
    SimTime now;    // the newest that it has heard of
    SimTime moved;  // of the newest odometry
    SimTime given;  // stamp of the newest set-point
  };
  Times times_;
  bool is_lockstep_ = false;  // the world waits
  int silent_looks_ = 0;      // of repeat(), before there was any odometry
  bool was_commanded_ = false;
};

}  // namespace trident::bridges
