// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "diagnostics_topic.h"

#include <diagnostic_msgs/DiagnosticArray.h>

#include <algorithm>

#include "conversions/conversions.h"

namespace trident::sim {
namespace {

using diagnostic_msgs::DiagnosticStatus;

/// The newest; the log has all of them.
constexpr std::size_t kRememberedMessages = 50;

DiagnosticStatus make_status(std::int8_t level, const std::string& name,
                             const std::string& message) {
  DiagnosticStatus status;
  status.level = level;
  status.name = "gazebo: " + name;
  status.message = one_line(message);
  return status;
}

std::int8_t level_of(Severity severity) {
  return severity == Severity::kError ? DiagnosticStatus::ERROR : DiagnosticStatus::WARN;
}

void add_value(DiagnosticStatus& status, const std::string& key, const std::string& value) {
  diagnostic_msgs::KeyValue pair;
  pair.key = key;
  pair.value = one_line(value);
  status.values.push_back(pair);
}

/// So many are listed; all are counted and logged.
constexpr std::size_t kListedElements = 20;

DiagnosticStatus odd_status(const std::vector<std::string>& odd) {
  DiagnosticStatus status =
      make_status(DiagnosticStatus::WARN, "odd elements",
                  std::to_string(odd.size()) + " elements of files were left out or changed");
  for (std::size_t i = 0; i < std::min(odd.size(), kListedElements); ++i) {
    add_value(status, std::to_string(i + 1), odd[i]);
  }
  add_value(status, "count", std::to_string(odd.size()));
  return status;
}

}  // namespace

DiagnosticStatus to_status(const DiagnosticEntry& entry) {
  const Diagnostic& newest = entry.newest;
  DiagnosticStatus status = make_status(level_of(newest.severity), newest.name(), newest.message);
  for (const auto& [key, value] : newest.values) add_value(status, key, value);
  add_value(status, "count", std::to_string(entry.count));
  add_value(status, "first_s", std::to_string(entry.first.seconds()));
  add_value(status, "last_s", std::to_string(entry.last.seconds()));
  return status;
}

DiagnosticsTopic::DiagnosticsTopic(ros::NodeHandle& node)
    : publisher_(node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10)) {}

void DiagnosticsTopic::remember(Severity severity, const std::string& text) {
  messages_.emplace_back(severity, text);
  if (messages_.size() > kRememberedMessages) messages_.erase(messages_.begin());
}

void DiagnosticsTopic::publish(const World& world, const Notes& notes) const {
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = to_ros(world.time());
  for (const auto& [name, message] : notes) {
    array.status.push_back(make_status(DiagnosticStatus::OK, name, message));
  }
  if (!world.odd_elements().empty()) array.status.push_back(odd_status(world.odd_elements()));
  for (const auto& [name, entry] : world.diagnostics().entries()) {
    array.status.push_back(to_status(entry));
  }
  for (std::size_t i = 0; i < messages_.size(); ++i) {
    const auto& [severity, text] = messages_[i];
    array.status.push_back(make_status(level_of(severity), "message " + std::to_string(i), text));
  }
  publisher_.publish(array);
}

}  // namespace trident::sim
