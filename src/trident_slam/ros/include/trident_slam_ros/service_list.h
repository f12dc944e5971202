// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "trident_base/error.h"
#include "trident_slam_ros/error_reporting_service.h"

namespace trident::slam {

/// Services of a node that throw: a request that cannot be executed fails; the caller and the log
/// learn why.
class ServiceList {
 public:
  /// `count`: called for each request that fails.
  explicit ServiceList(
      const ros::NodeHandle& handle,
      std::function<void(const std::string&)> count = [](const std::string&) {})
      : handle_(handle), count_(std::move(count)) {}

  /// `answer(request, response)`.
  template <class Service, class Answer>
  void serve(const std::string& name, const Answer& answer) {
    const auto failed = [this, name](const std::string& text) {
      ROS_ERROR("%s: %s", name.c_str(), text.c_str());
      count_(name + ": " + text);
    };
    ros::AdvertiseServiceOptions options = error_reporting_service<Service>(name, answer, failed);
    servers_.push_back(handle_.advertiseService(options));
  }

 private:
  ros::NodeHandle handle_;
  std::function<void(const std::string&)> count_;
  std::vector<ros::ServiceServer> servers_;
};

/// A session file's path; slam_toolbox' services name files without an ending. Throws Error for an
/// empty name.
inline std::string session_file(const std::string& name) {
  if (name.empty()) throw Error("filename is empty, legal: a path without an ending");
  return name + ".posegraph";
}

}  // namespace trident::slam
