// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "performance_topic.h"

#include <gazebo_msgs/PerformanceMetrics.h>

#include "conversions/conversions.h"

namespace trident::sim {
namespace {

constexpr auto kPeriod = std::chrono::milliseconds(200);
constexpr double kNotACamera = -1.0;  ///< frames per second of other sensors

bool is_measured(const PortBase& port) {
  return port.direction() == PortDirection::kOut && port.rank() == PortRank::kSensor &&
         port.wanted();
}

}  // namespace

PerformanceTopic::PerformanceTopic(ros::NodeHandle& node)
    : publisher_(
          node.advertise<gazebo_msgs::PerformanceMetrics>("/gazebo/performance_metrics", 10)) {}

void PerformanceTopic::begin(const World& world, Clock::time_point now) {
  is_measuring_ = true;
  begin_ = now;
  begin_time_ = world.time();
  begin_counts_.clear();
  world.ports().for_each([this](const PortBase& port) {
    if (is_measured(port)) begin_counts_[port.name()] = port.count();
  });
}

void PerformanceTopic::publish(const World& world) {
  const auto now = Clock::now();
  if (publisher_.getNumSubscribers() == 0) {
    is_measuring_ = false;
    return;
  }
  if (!is_measuring_ || world.time() < begin_time_) begin(world, now);
  if (now - begin_ < kPeriod) return;
  const double wall_s = std::chrono::duration<double>(now - begin_).count();
  const double sim_s = (world.time() - begin_time_).seconds();
  gazebo_msgs::PerformanceMetrics message;
  message.header.stamp = to_ros(world.time());
  message.real_time_factor = sim_s / wall_s;
  world.ports().for_each([&](const PortBase& port) {
    const auto before = begin_counts_.find(port.name());
    if (!is_measured(port) || before == begin_counts_.end()) return;
    // A new port with the name of an earlier one may have a smaller count than that.
    const double samples =
        port.count() < before->second ? 0.0 : static_cast<double>(port.count() - before->second);
    gazebo_msgs::SensorPerformanceMetric sensor;
    sensor.name = port.name();
    sensor.sim_update_rate = sim_s > 0.0 ? samples / sim_s : 0.0;
    sensor.real_update_rate = samples / wall_s;
    sensor.fps = kNotACamera;
    message.sensors.push_back(sensor);
  });
  publisher_.publish(message);
  begin(world, now);
}

}  // namespace trident::sim
