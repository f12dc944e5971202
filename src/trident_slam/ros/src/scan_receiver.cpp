// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/scan_receiver.h"

#include <cmath>
#include <utility>
#include <vector>

#include "trident_base/string_util.h"

namespace trident::slam {
namespace {

constexpr double kIntakePeriod_s = 0.005;  // wall time

ScanIntakeOptions intake_options(const SlamNodeOptions& options) {
  ScanIntakeOptions result;
  result.odom_frame = options.odom_frame;
  result.base_frame = options.base_frame;
  result.transform_timeout = options.transform_timeout;
  result.waits_for_all = options.is_sync;
  result.uses_mount = options.uses_mount;
  result.uses_gyro = !options.imu_topic.empty();
  return result;
}

}  // namespace

ScanReceiver::ScanReceiver(ros::NodeHandle node, const SlamNodeOptions& options, ScanQueue& queue,
                           SlamDiagnostics& diagnostics, std::function<void()> on_restart)
    : options_(options),
      queue_(queue),
      diagnostics_(diagnostics),
      on_restart_(std::move(on_restart)),
      transforms_(ros::Duration(options.tf_buffer_duration)),
      intake_(intake_options(options), transforms_),
      stamps_(options.bag_loop_threshold) {
  inputs_.transforms = std::make_unique<ros_utils::TransformInput>(
      transforms_, [this](const std::string& problem) { diagnostics_.report(problem); });
  timer_ = node.createWallTimer(ros::WallDuration(kIntakePeriod_s),
                                [this](const ros::WallTimerEvent&) { hand_over(); });
  subscribe(node);
}

void ScanReceiver::stop() {
  inputs_.transforms.reset();
  inputs_.scans.shutdown();
  inputs_.imu.shutdown();
}

void ScanReceiver::subscribe(ros::NodeHandle& node) {
  if (!options_.imu_topic.empty()) {
    inputs_.imu = node.subscribe<sensor_msgs::Imu>(
        options_.imu_topic, 0,
        [this](const sensor_msgs::ImuConstPtr& message) { intake_.add(*message); });
  }
  // Without a limit in synchronous mode: no scan may be lost.
  const int queue_size = options_.is_sync ? 0 : options_.scan_queue_size;
  inputs_.scans = node.subscribe(options_.scan_topic, static_cast<std::uint32_t>(queue_size),
                                 &ScanReceiver::receive, this);
}

void ScanReceiver::receive(const sensor_msgs::LaserScanConstPtr& message) {
  if (!intake_.is_refused(*message, ros::Time::now())) {
    const ScanStamps::Step step = stamps_.add(message);
    follow_time(step);
    for (const auto& scan : step.scans) take(scan);
  }
  hand_over();
}

void ScanReceiver::follow_time(const ScanStamps::Step& step) {
  if (!step.problem.empty()) diagnostics_.report(step.problem);
  if (step.was_ahead) intake_.leave_out_after(step.scans.front()->header.stamp, step.problem);
  if (!step.went_back) return;
  intake_.clear();
  diagnostics_.report("time went back by " + number_text(step.went_back->toSec()) +
                      " s (a bag that is played in a loop?); parameter bag_loop");
  bag_loop_.is_active = options_.bag_loop == BagLoop::kIgnore;
  bag_loop_.end = *step.back_from;
  if (options_.bag_loop == BagLoop::kRestart) on_restart_();
}

/// What was mapped before is passed over.
bool ScanReceiver::is_in_bag_loop(const sensor_msgs::LaserScan& message) {
  if (message.header.stamp > bag_loop_.end) bag_loop_.is_active = false;
  return bag_loop_.is_active;
}

// Stamps are labels: a scan that is a little older than the last one is a scan like others.
void ScanReceiver::take(const sensor_msgs::LaserScanConstPtr& message) {
  if (is_in_bag_loop(*message) || is_paused_) return;
  const double passed = std::abs((message->header.stamp - throttle_.last).toSec());
  if (!throttle_.last.isZero() && passed < options_.minimum_time_interval) return;
  if (throttle_.count++ % static_cast<std::size_t>(options_.throttle_scans) != 0) return;
  throttle_.last = message->header.stamp;
  intake_.add(message);
}

void ScanReceiver::hand_over() {
  std::vector<ScanRecord> records = intake_.take();
  if (intake_.problems().count() > reported_problems_) {
    reported_problems_ = intake_.problems().count();
    diagnostics_.warn(intake_.last_problem());
  }
  queue_.push(std::move(records));
}

ScanCounts ScanReceiver::counts() {
  ScanCounts counts;
  counts.received = intake_.received();
  counts.waiting_for_transforms = intake_.waiting();
  counts.waiting_for_slam = queue_.size();
  counts.replaced = queue_.replaced();
  counts.left_out = intake_.left_out();
  counts.without_gyro = intake_.without_gyro();
  counts.problems = intake_.problems().count();
  counts.is_paused = is_paused_;
  return counts;
}

}  // namespace trident::slam
