// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gazebo_msgs/LinkStates.h>
#include <gazebo_msgs/ModelStates.h>
#include <ros/ros.h>
#include <trident_msgs/FleetState.h>

#include <chrono>

#include "trident_sim/world.h"

namespace trident::sim {

/// /clock, /gazebo/model_states, /gazebo/link_states and /gazebo/fleet_state.
class StateTopics {
 public:
  /// `max_rate_hz`: wall rate above which nothing but the fleet state is sent;
  /// `clock_frequency_hz`: simulated rate of /clock, 0: every step.
  StateTopics(ros::NodeHandle& node, double max_rate_hz, double clock_frequency_hz);

  /// After a step. `every_step`: the wall rate does not matter.
  void publish(const World& world, bool every_step);
  /// While time stands: sends the last /clock if the wall rate held it back.
  void catch_up_clock(SimTime time);
  /// Sends /clock unless this time is out already.
  void publish_clock(SimTime time);
  /// New listeners of the fleet state get the present one at once, even while time stands.
  void scan(const World& world);
  /// The fleet state is sent at the multiples of this.
  void set_state_period(SimTime period) { state_period_ = period; }
  void restart() {
    clock_sent_ = {-1};
    fleet_models_ = 0;
  }

 private:
  using Clock = std::chrono::steady_clock;
  bool is_clock_due(SimTime time) const;
  bool may_send(Clock::time_point last, Clock::time_point now, bool every_step) const;
  void publish_states(const World& world);
  void publish_fleet(const World& world);
  void publish_models(const World& world);
  void publish_links(const World& world);

  ros::Publisher clock_, models_, links_, fleet_;
  Clock::duration least_interval_;
  Clock::time_point last_clock_, last_states_;
  SimTime clock_period_;
  SimTime clock_sent_{-1};
  SimTime state_period_{100'000'000};
  std::uint32_t fleet_listeners_ = 0;
  std::size_t fleet_models_ = 0;
};

}  // namespace trident::sim
