// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <ros/ros.h>

#include <string>

#include "trident_estimation_ros/amcl_localizer.h"
#include "trident_estimation_ros/amcl_node_params.h"
#include "trident_estimation_ros/scan_input.h"
#include "trident_ros/diagnostic_counter.h"

namespace trident::estimation {

/// Publishes on /diagnostics, every second of wall time and to subscribers only, how certain the
/// estimate is and which problems were counted.
class AmclDiagnostics {
 public:
  /// All arguments but the node must outlive it.
  AmclDiagnostics(ros::NodeHandle& node, const AmclNodeParams& params,
                  const AmclLocalizer& localizer, const ScanInput& scans,
                  ros_utils::DiagnosticCounter& problems);

 private:
  void publish();
  diagnostic_msgs::DiagnosticStatus status() const;
  void add_estimate(diagnostic_msgs::DiagnosticStatus& status) const;

  const AmclNodeParams& params_;
  const AmclLocalizer& localizer_;
  const ScanInput& scans_;
  ros_utils::DiagnosticCounter& problems_;
  std::string name_;
  ros::Publisher publisher_;
  ros::WallTimer timer_;
};

}  // namespace trident::estimation
