// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "run/server_options.h"
#include "topics/port_binder.h"
#include "trident_base/mutex.h"
#include "trident_sim/world.h"
#include "vehicle_link.h"

namespace trident::sim {

/// The vehicles of the world that take motor commands, each with its link, and the hub that the
/// links share. Used by threads that hold the world's mutex; the hub has a mutex of its own.
class VehicleTable {
 public:
  /// By name of the port that takes the commands.
  using Links = std::map<std::string, std::unique_ptr<VehicleLink>>;

  VehicleTable(ros::NodeHandle& node, const ServerOptions& options, Repeatability& repeatability,
               NodeProbe& probe);
  ~VehicleTable();
  VehicleTable(const VehicleTable&) = delete;
  VehicleTable& operator=(const VehicleTable&) = delete;

  /// Links the vehicles that came, and drops those that went. `is_confirming_open`: whether the
  /// controllers of new ones confirm set-points is not known yet.
  void sync(World& world, PortBinder& binder, bool is_confirming_open);

  const Links& links() const { return links_; }
  LockstepHub& hub() { return hub_; }
  std::size_t size() const { return links_.size(); }

  /// Reads the set-points of these vehicles themselves, see VehicleLink::watch_setpoints().
  void watch_setpoints(const std::vector<std::string>& names);
  /// Name of each vehicle and whether its controller is in lockstep.
  std::vector<std::pair<std::string, bool>> states();

 private:
  void unlink_gone(const std::map<std::string, InPort<ActuatorCommand>*>& commanded);

  ros::NodeHandle& node_;
  ros_utils::InlineCallbackQueue inline_queue_;
  LockstepHub hub_;
  Links links_;
};

}  // namespace trident::sim
