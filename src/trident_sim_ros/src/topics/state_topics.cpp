// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "state_topics.h"

#include <rosgraph_msgs/Clock.h>

#include "conversions/conversions.h"

namespace trident::sim {
namespace {

geometry_msgs::Twist to_twist(const Link& link) {
  geometry_msgs::Twist twist;
  twist.linear = to_vector(link.v_world_at(link.T_world_link().p));
  twist.angular = to_vector(link.w_world());
  return twist;
}

geometry_msgs::Twist model_twist(const Model& model) {
  const Link* link = model.canonical_link();
  if (link == nullptr) return {};
  geometry_msgs::Twist twist;
  twist.linear = to_vector(link->v_world_at(model.T_world_model().p));
  twist.angular = to_vector(link->w_world());
  return twist;
}

}  // namespace

StateTopics::StateTopics(ros::NodeHandle& node, double max_rate_hz, double clock_frequency_hz)
    : least_interval_(std::chrono::duration_cast<Clock::duration>(
          std::chrono::duration<double>(1.0 / max_rate_hz))),
      clock_period_(clock_frequency_hz > 0.0 ? SimTime::from_seconds(1.0 / clock_frequency_hz)
                                             : SimTime{0}) {
  // Latched, so that a node that starts while the world stands has a time.
  clock_ = node.advertise<rosgraph_msgs::Clock>("/clock", 10, true);
  models_ = node.advertise<gazebo_msgs::ModelStates>("/gazebo/model_states", 10);
  links_ = node.advertise<gazebo_msgs::LinkStates>("/gazebo/link_states", 10);
  fleet_ = node.advertise<trident_msgs::FleetState>("/gazebo/fleet_state", 100, true);
}

/// At the simulated rate that is asked for.
bool StateTopics::is_clock_due(SimTime time) const {
  return clock_period_.ns == 0 || clock_sent_.ns < 0 || time - clock_sent_ >= clock_period_;
}

/// By the wall rate of displays.
bool StateTopics::may_send(Clock::time_point last, Clock::time_point now, bool every_step) const {
  return every_step || now - last >= least_interval_;
}

void StateTopics::publish_states(const World& world) {
  if (models_.getNumSubscribers() > 0) publish_models(world);
  if (links_.getNumSubscribers() > 0) publish_links(world);
}

void StateTopics::publish(const World& world, bool every_step) {
  const auto now = Clock::now();
  if (is_clock_due(world.time()) && may_send(last_clock_, now, every_step)) {
    last_clock_ = now;
    publish_clock(world.time());
  }
  if (may_send(last_states_, now, every_step)) {
    last_states_ = now;
    publish_states(world);
  }
  if (world.time().ns % state_period_.ns == 0 && fleet_.getNumSubscribers() > 0)
    publish_fleet(world);
}

void StateTopics::catch_up_clock(SimTime time) {
  const auto now = Clock::now();
  // The newest time, which the limit of the rate has kept back.
  if (clock_period_.ns > 0 || now - last_clock_ < least_interval_) return;
  last_clock_ = now;
  publish_clock(time);
}

void StateTopics::publish_clock(SimTime time) {
  if (time == clock_sent_) return;
  clock_sent_ = time;
  rosgraph_msgs::Clock message;
  message.clock = to_ros(time);
  clock_.publish(message);
}

void StateTopics::scan(const World& world) {
  const std::uint32_t listeners = fleet_.getNumSubscribers();
  // Sources that wait for time zero must have the first state, though no step publishes it.
  const bool standing = world.time().ns % state_period_.ns == 0;
  const bool is_news = listeners > fleet_listeners_ || world.models().size() != fleet_models_;
  fleet_listeners_ = listeners;
  fleet_models_ = world.models().size();
  if (is_news && listeners > 0 && standing && world.step_count() == 0) publish_fleet(world);
}

void StateTopics::publish_fleet(const World& world) {
  trident_msgs::FleetState message;
  message.header.stamp = to_ros(world.time());
  message.header.frame_id = "world";
  for (const auto& [name, model] : world.models()) {
    if (model->is_static) continue;
    message.name.push_back(name);
    message.pose.push_back(to_pose(model->T_world_model()));
    message.twist.push_back(model_twist(*model));
  }
  fleet_.publish(message);
}

void StateTopics::publish_models(const World& world) {
  gazebo_msgs::ModelStates message;
  for (const auto& [name, model] : world.models()) {
    message.name.push_back(name);
    message.pose.push_back(to_pose(model->T_world_model()));
    message.twist.push_back(model_twist(*model));
  }
  models_.publish(message);
}

void StateTopics::publish_links(const World& world) {
  gazebo_msgs::LinkStates message;
  for (const auto& [name, model] : world.models()) {
    for (const auto& link : model->links) {
      message.name.push_back(name + "::" + link->name);
      message.pose.push_back(to_pose(link->T_world_link()));
      message.twist.push_back(to_twist(*link));
    }
  }
  links_.publish(message);
}

}  // namespace trident::sim
