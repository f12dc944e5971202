// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <cstdint>
#include <functional>

#include "trident_bridges_ros/node_poll_loop.h"

namespace trident::bridges::modbus {

/// Calls a function at a fixed period in the loop's thread: of simulated time where the node has
/// it, of wall time otherwise. Ticks that were missed are left out. One of them in a node, since it
/// follows /clock.
class NodeTicker {
 public:
  /// `loop` outlives the ticker; `period_s` is positive.
  NodeTicker(ros::NodeHandle& node, NodePollLoop& loop, double period_s,
             std::function<void()> tick);
  ~NodeTicker();
  NodeTicker(const NodeTicker&) = delete;
  NodeTicker& operator=(const NodeTicker&) = delete;

 private:
  void on_time(double now_s);
  void schedule();

  NodePollLoop& loop_;
  double period_s_;
  std::function<void()> tick_;
  double next_s_ = 0.0;     ///< of simulated or of wall time
  std::uint64_t call_ = 0;  ///< of wall time
};

}  // namespace trident::bridges::modbus
