// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_ros/refusals.h"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/console.h>
#include <ros/this_node.h>

namespace trident::ros_utils {
namespace {

constexpr double kLogEveryS = 5.0;      // wall time
constexpr double kPublishEveryS = 0.5;  // wall time

}  // namespace

Refusals::Refusals(ros::NodeHandle& node, const std::string& owner)
    : owner_(owner.substr(1)),
      prefix_(owner == ros::this_node::getName() ? "" : owner + ": "),
      diagnostics_(node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10)),
      // Of the last refusal, too, if it came soon after the one before.
      timer_(node.createWallTimer(ros::WallDuration(kPublishEveryS),
                                  [this](const ros::WallTimerEvent&) { publish_if_due(); })) {}

void Refusals::note(const std::string& kind, const std::string& text) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    Kind& known = counted(kind, text);
    const ros::WallTime now = ros::WallTime::now();
    if (known.logged == 0 || (now - known.logged_at).toSec() >= kLogEveryS) {
      const std::uint64_t more = known.count - known.logged - 1;
      ROS_ERROR("%s%s%s", prefix_.c_str(), text.c_str(),
                more == 0 ? "" : (" (and " + std::to_string(more) + " before it)").c_str());
      known.logged = known.count;
      known.logged_at = now;
    }
  }
  publish_if_due();
}

void Refusals::count(const std::string& kind, const std::string& text) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    counted(kind, text);
  }
  publish_if_due();
}

/// While locked.
Refusals::Kind& Refusals::counted(const std::string& kind, const std::string& text) {
  Kind& known = kinds_[kind];
  known.newest = text;
  ++known.count;
  has_news_ = true;
  return known;
}

void Refusals::publish_if_due() {
  if (const auto news = due_news()) diagnostics_.publish(*news);
}

std::optional<diagnostic_msgs::DiagnosticArray> Refusals::due_news() {
  const std::lock_guard<std::mutex> lock(mutex_);
  const ros::WallTime now = ros::WallTime::now();
  if (!has_news_ || (now - published_at_).toSec() < kPublishEveryS) return std::nullopt;
  published_at_ = now;
  has_news_ = false;
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = ros::Time::now();
  for (const auto& [kind, known] : kinds_) {
    diagnostic_msgs::DiagnosticStatus status;
    status.level = diagnostic_msgs::DiagnosticStatus::WARN;
    status.name = owner_ + ": " + kind;
    status.message = known.newest;
    diagnostic_msgs::KeyValue count;
    count.key = "count";
    count.value = std::to_string(known.count);
    status.values.push_back(count);
    array.status.push_back(status);
  }
  return array;
}

}  // namespace trident::ros_utils
