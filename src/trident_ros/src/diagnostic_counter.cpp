// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_ros/diagnostic_counter.h"

#include <ros/console.h>

namespace trident::ros_utils {

diagnostic_msgs::KeyValue key_value(const std::string& key, const std::string& value) {
  diagnostic_msgs::KeyValue result;
  result.key = key;
  result.value = value;
  return result;
}

void DiagnosticCounter::note(const std::string& kind, const std::string& text) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Entry& entry = entries_[kind];
  entry.newest = text;
  if (++entry.count == 1) ROS_WARN("%s (further ones are counted in /diagnostics)", text.c_str());
}

void DiagnosticCounter::add_to(diagnostic_msgs::DiagnosticArray& array,
                               const std::string& node) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const auto& [kind, entry] : entries_) {
    diagnostic_msgs::DiagnosticStatus status;
    status.level = diagnostic_msgs::DiagnosticStatus::WARN;
    status.name = node + ": " + kind;
    status.message = entry.newest;
    status.values.push_back(key_value("count", std::to_string(entry.count)));
    array.status.push_back(status);
  }
}

}  // namespace trident::ros_utils
