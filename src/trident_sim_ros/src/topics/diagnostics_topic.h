// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <ros/ros.h>

#include <string>
#include <utility>
#include <vector>

#include "trident_sim/world.h"

namespace trident::sim {

/// "gazebo: <name>", with the values, the count and the simulated times of the first and the last.
diagnostic_msgs::DiagnosticStatus to_status(const DiagnosticEntry& entry);

/// /diagnostics: how the simulation goes, what World::diagnostics() keeps, and the latest messages
/// besides.
class DiagnosticsTopic {
 public:
  explicit DiagnosticsTopic(ros::NodeHandle& node);

  /// A message of the log that World::diagnostics() does not keep.
  void remember(Severity severity, const std::string& text);

  /// What goes well, as (name, message).
  using Notes = std::vector<std::pair<std::string, std::string>>;
  bool wanted() const { return publisher_.getNumSubscribers() > 0; }
  void publish(const World& world, const Notes& notes) const;

 private:
  ros::Publisher publisher_;
  std::vector<std::pair<Severity, std::string>> messages_;
};

}  // namespace trident::sim
