// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <memory>
#include <vector>

#include "core/mavros_params.h"
#include "core/packet_topics.h"
#include "core/plugin.h"
#include "core/ros_side.h"
#include "core/vehicle_side.h"
#include "trident_bridges_ros/node_poll_loop.h"

namespace trident::mavros {

/// A vehicle that speaks MAVLink, as topics and services below a name: that of mavros_node, or one
/// of several in its process.
class MavrosNode {
 public:
  /// Opens the link and makes the plugins; `private_node`: its name. `loop` and `transforms` must
  /// outlive it. Throws Error naming a parameter
  /// or a URL.
  MavrosNode(const ros::NodeHandle& private_node, bridges::NodePollLoop& loop,
             Transforms& transforms, const MavrosParams& params)
      : params_(params),
        ros_(private_node, loop, transforms),
        vehicle_(params_, ros_.refusals(), loop.loop()),
        hub_{ros_, vehicle_, params_, {}},
        packets_(ros::NodeHandle(ros::names::parentNamespace(private_node.getNamespace())),
                 vehicle_, loop) {
    follow_attitude(hub_);
    plugins_ = make_plugins(hub_);
    constexpr double kTick_s = 0.05;
    ros_.every(kTick_s, [this] { vehicle_.tick(); });
  }

  std::size_t plugins() const { return plugins_.size(); }  ///< that are loaded

 private:
  MavrosParams params_;
  RosSide ros_;
  VehicleSide vehicle_;
  Hub hub_;
  PacketTopics packets_;
  std::vector<std::unique_ptr<Plugin>> plugins_;
};

}  // namespace trident::mavros
