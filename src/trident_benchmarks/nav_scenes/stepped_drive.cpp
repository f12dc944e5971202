// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "stepped_drive.h"

#include <cmath>

#include "odometry.h"
#include "thread_cpu.h"

namespace trident::benchmarks {
namespace {

SE3 planar(const nav::Pose2& pose) {
  return SE3::from_xyz_rpy({pose.x, pose.y, 0.0}, 0.0, 0.0, pose.yaw);
}

}  // namespace

SteppedDrive::SteppedDrive(const TrialConfig& config, const ConfigNode& parameters,
                           std::uint64_t seed)
    : start_{config.start[0], config.start[1], config.start[2]},
      command_delay_s_(config.command_delay_s),
      robot_(config, seed),
      stack_(parameters) {}

nav::Pose2 SteppedDrive::pose() const {
  if (!is_localized_) return robot_.odometry().pose();
  const nav::Pose2 truth = robot_.truth();
  const double c = std::cos(start_.yaw), s = std::sin(start_.yaw);
  const double dx = truth.x - start_.x, dy = truth.y - start_.y;
  return {c * dx + s * dy, c * dy - s * dx, nav::wrap_angle(truth.yaw - start_.yaw)};
}

void SteppedDrive::send_commands() {
  while (!underway_.empty() && underway_.front().due_s <= time_s()) {
    robot_.command(underway_.front().twist);
    underway_.pop_front();
  }
}

void SteppedDrive::hand_over_scan() {
  auto scan = robot_.take_scan();
  if (!scan || !is_lidar_on_) return;
  if (is_localized_) {
    const SE3 T_true_odom = planar(pose()) * planar(robot_.odometry().pose()).inverse();
    scan->T_odom_laser = T_true_odom * scan->T_odom_laser;
    scan->T_odom_laser_end = T_true_odom * scan->T_odom_laser_end;
  }
  stack_.add_scan(*scan);
}

std::optional<nav::NavigatorOutput> SteppedDrive::step() {
  send_commands();
  robot_.step();
  hand_over_scan();
  if (!stack_.is_control_due(time_s())) return std::nullopt;
  const double begin_s = thread_cpu_s();
  const auto& odometry = robot_.odometry();
  const double state_s = is_localized_ ? time_s() : robot_.odometry_time_s();
  nav::NavigatorOutput output = stack_.cycle(time_s(), {pose(), odometry.twist(), state_s});
  navigation_cpu_s_ += thread_cpu_s() - begin_s;
  const bool is_idle = output.status == nav::NavigatorStatus::kIdle;
  command_ = is_idle ? nav::Twist2{} : output.twist;
  underway_.push_back({time_s() + command_delay_s_, command_});
  return output;
}

}  // namespace trident::benchmarks
