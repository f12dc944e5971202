// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/slam_node.h"

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <vector>

#include "trident_base/error.h"
#include "trident_maps/map_file.h"
#include "trident_slam/slam_2d_capabilities.h"

namespace trident::slam {
namespace {

/// Returns the file, without an ending, that a map is saved to when the node has to end.
std::string rescue_stem(const SlamNodeOptions& options) {
  namespace fs = std::filesystem;
  if (!options.autosave_file.empty()) {
    return fs::path(options.autosave_file).replace_extension().string() + "_rescued";
  }
  const char* const ros_home = std::getenv("ROS_HOME");
  const char* const home = std::getenv("HOME");
  const fs::path directory =
      ros_home != nullptr ? fs::path(ros_home) : fs::path(home != nullptr ? home : ".") / ".ros";
  std::string name = ros::this_node::getName().substr(1);
  for (char& letter : name) {
    if (letter == '/') letter = '_';
  }
  return (directory / (name + "_rescued")).string();
}

ros::NodeHandle on_queue(ros::NodeHandle handle, ros::CallbackQueue* queue) {
  handle.setCallbackQueue(queue);
  return handle;
}

}  // namespace

SlamNode::SlamNode(const ros::NodeHandle& private_handle, const SlamNodeOptions& options,
                   MakeSlam make)
    : options_(options),
      slam_(std::move(make), !options.odom_frame.empty()),
      diagnostics_(ros::NodeHandle()),
      scans_(options.is_sync),
      outputs_{{ros::NodeHandle(), options}, {ros::NodeHandle(), private_handle, options}},
      map_(ros::NodeHandle(), on_queue(private_handle, &slow_queue_), options, slam_,
           [this](const std::string& problem) { report(problem); }),
      autosave_(
          options.autosave_file, options.autosave_interval,
          [this] { return slam_.session_snapshot(); },
          [this](const std::string& problem) { report(problem); }),
      receiver_(ros::NodeHandle(), options, scans_, diagnostics_, [this] { reset(); }) {
  diagnostics_.start(ros::NodeHandle(), [this] { return receiver_.counts(); });
  crash_rescue_ =
      std::make_unique<CrashRescue>([this] { slam_.rescue_after_crash(rescue_stem(options_)); });
  worker_ = std::thread([this] { work(); });
  slow_spinner_.start();
}

SlamNode::~SlamNode() {
  slow_spinner_.stop();
  receiver_.stop();
  scans_.end();
  worker_.join();
  autosave_.finish();
}

void SlamNode::work() {
  while (const std::optional<ScanRecord> record = scans_.pop()) {
    try {
      consume(*record);
    } catch (const Error& error) {
      report(std::string("scan is not used: ") + error.what());
    } catch (const std::exception& error) {
      rescue(error.what());
      return;
    }
  }
}

void SlamNode::consume(const ScanRecord& record) {
  const ros::Time stamp = ros::Time().fromNSec(static_cast<std::uint64_t>(record.scan.stamp_ns));
  autosave_.before_scan(stamp);
  std::vector<CalibrationEstimate> calibration;
  const ScanPose2d pose = slam_.with([&](Slam2d& slam) {
    ScanPose2d result = slam.add_scan(record.scan, record.T_odom_base);
    const auto* calibrated = dynamic_cast<const Slam2dCalibrated*>(&slam);
    if (calibrated != nullptr) calibration = calibrated->odometry_calibration();
    return result;
  });
  diagnostics_.add_scan(pose, std::move(calibration));
  outputs_.transform.set(pose.T_map_base * record.T_odom_base.inverse());
  outputs_.poses.publish(record, pose);
  if (on_scan_) on_scan_(record, pose);
  map_.publish_if_due(stamp);
  autosave_.after_scan(stamp);
}

void SlamNode::run() {
  try {
    ros::spin();
  } catch (const std::exception& error) {
    rescue(error.what());
  }
  const Lock lock(end_.mutex);
  if (!end_.text.empty()) throw std::runtime_error(end_.text);
}

/// After an exception that no code expects: saves what is mapped, and ends the node.
void SlamNode::rescue(const std::string& why) {
  const std::string stem = rescue_stem(options_);
  slam_.rescue(stem);
  const Lock lock(end_.mutex);
  end_.text = why + " (unforeseen); the map is in " + stem + ".*";
  ros::requestShutdown();
}

void SlamNode::save_map(const std::string& stem) {
  if (options_.is_sync) with_slam([](Slam2d& slam) { slam.finish(); });
  trident::maps::save_map(stem, slam_.map_snapshot()());
}

void SlamNode::reset() {
  clear_queue();
  slam_.reset();
  forget_correction();
  receiver_.end_bag_loop();
}

}  // namespace trident::slam
