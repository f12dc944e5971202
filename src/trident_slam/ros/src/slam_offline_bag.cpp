// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// slam_offline_bag FILE.bag --method NAME [--config FILE] --out DIR: as slam_offline, of a rosbag.
#include <memory>
#include <string>

#include "trident_slam/offline_program.h"
#include "trident_slam_ros/bag_scans.h"

namespace trident::slam {
namespace {

std::unique_ptr<ScanSource> open_bag(const OfflineCommand& command) {
  const auto value = [&command](const char* name) {
    const auto found = command.source.find(name);
    return found == command.source.end() ? std::string() : found->second;
  };
  BagScansOptions options;
  options.scan_topic = value("scan");
  options.odom_topic = value("odom");
  options.imu_topic = value("imu");
  options.odom_frame = value("odom-frame");
  options.uses_odometry = command.uses_odometry;
  options.base_frame = value("base-frame");
  return std::make_unique<BagScans>(command.log_file, options);
}

}  // namespace
}  // namespace trident::slam

int main(int argc, char** argv) {
  return trident::slam::run_offline_program(
      argc, argv, {"--scan", "--odom", "--imu", "--odom-frame", "--base-frame"},
      trident::slam::open_bag);
}
