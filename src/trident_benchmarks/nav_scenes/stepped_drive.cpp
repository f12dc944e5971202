// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "stepped_drive.h"

#include <ctime>

#include "odometry.h"

namespace trident::benchmarks {
namespace {

double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

SteppedDrive::SteppedDrive(const TrialConfig& config, const ConfigNode& parameters,
                           std::uint64_t seed)
    : command_delay_s_(config.command_delay_s), robot_(config, seed), stack_(parameters) {}

std::optional<nav::NavigatorOutput> SteppedDrive::step() {
  while (!underway_.empty() && underway_.front().due_s <= time_s()) {
    robot_.command(underway_.front().twist);
    underway_.pop_front();
  }
  robot_.step();
  const auto scan = robot_.take_scan();
  if (scan && is_lidar_on_) stack_.add_scan(*scan);
  if (!stack_.is_control_due(time_s())) return std::nullopt;
  const double begin_s = thread_cpu_s();
  const Odometry& odometry = robot_.odometry();
  nav::NavigatorOutput output =
      stack_.cycle(time_s(), {odometry.pose(), odometry.twist(), robot_.odometry_time_s()});
  navigation_cpu_s_ += thread_cpu_s() - begin_s;
  const bool is_idle = output.status == nav::NavigatorStatus::kIdle;
  command_ = is_idle ? nav::Twist2{} : output.twist;
  underway_.push_back({time_s() + command_delay_s_, command_});
  return output;
}

}  // namespace trident::benchmarks
