// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/slam_node_options.h"

#include <array>
#include <cmath>
#include <utility>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::slam {
namespace {

struct TextParameter {
  const char* name;
  std::string SlamNodeOptions::*value;
};

struct NumberParameter {
  const char* name;
  double SlamNodeOptions::*value;
  double least;
};

using O = SlamNodeOptions;

constexpr std::array<TextParameter, 6> kTexts = {{{"map_frame", &O::map_frame},
                                                  {"odom_frame", &O::odom_frame},
                                                  {"base_frame", &O::base_frame},
                                                  {"scan_topic", &O::scan_topic},
                                                  {"imu_topic", &O::imu_topic},
                                                  {"autosave_file", &O::autosave_file}}};

constexpr std::array<NumberParameter, 10> kNumbers = {
    {{"transform_publish_period", &O::transform_publish_period, 0.0},
     {"transform_timeout", &O::transform_timeout, 0.0},
     {"tf_buffer_duration", &O::tf_buffer_duration, 0.1},
     {"map_update_interval", &O::map_update_interval, 0.0},
     {"map_changes_interval", &O::map_changes_interval, 0.0},
     {"minimum_time_interval", &O::minimum_time_interval, 0.0},
     {"position_covariance_scale", &O::position_covariance_scale, 0.0},
     {"yaw_covariance_scale", &O::yaw_covariance_scale, 0.0},
     {"bag_loop_threshold", &O::bag_loop_threshold, 0.0},
     {"autosave_interval", &O::autosave_interval, 0.0}}};

constexpr const char* kThrottleScans = "throttle_scans";
constexpr const char* kBagLoop = "bag_loop";
constexpr std::array<std::pair<const char*, BagLoop>, 3> kBagLoops = {
    {{"ignore", BagLoop::kIgnore},
     {"restart", BagLoop::kRestart},
     {"continue", BagLoop::kContinue}}};

Error illegal(const ros::NodeHandle& handle, const char* name, const std::string& value,
              const std::string& legal) {
  return Error("parameter " + handle.resolveName(name) + " is " + value + ", legal: " + legal);
}

void read_bag_loop(const ros::NodeHandle& handle, BagLoop& value) {
  std::string text;
  if (!handle.getParam(kBagLoop, text)) return;
  for (const auto& [name, policy] : kBagLoops) {
    if (text == name) {
      value = policy;
      return;
    }
  }
  throw illegal(handle, kBagLoop, "'" + text + "'", "ignore, restart, continue");
}

}  // namespace

void read_options(const ros::NodeHandle& handle, SlamNodeOptions& options) {
  for (const TextParameter& text : kTexts) handle.getParam(text.name, options.*text.value);
  for (const NumberParameter& number : kNumbers) {
    double& value = options.*number.value;
    handle.getParam(number.name, value);
    if (!std::isfinite(value) || value < number.least) {
      throw illegal(handle, number.name, number_text(value),
                    number_text(number.least) + " and above");
    }
  }
  handle.getParam(kThrottleScans, options.throttle_scans);
  if (options.throttle_scans < 1) {
    throw illegal(handle, kThrottleScans, std::to_string(options.throttle_scans), "1 and above");
  }
  read_bag_loop(handle, options.bag_loop);
}

std::vector<std::string> slam_node_parameters() {
  std::vector<std::string> names = {kThrottleScans, kBagLoop};
  for (const TextParameter& text : kTexts) names.emplace_back(text.name);
  for (const NumberParameter& number : kNumbers) names.emplace_back(number.name);
  return names;
}

}  // namespace trident::slam
