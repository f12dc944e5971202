// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <memory>
#include <vector>

#include "trident_bridges_ros/nmea/nmea_link.h"

namespace trident::bridges {

/// Publishes what links have carried once a second of wall time, on /diagnostics.
class LinkDiagnostics {
 public:
  /// `links` outlive it; `node`'s callback queue is served by the thread that serves the links.
  LinkDiagnostics(ros::NodeHandle& node, const std::vector<std::unique_ptr<NmeaLink>>& links);

 private:
  void publish();

  const std::vector<std::unique_ptr<NmeaLink>>& links_;
  ros::Publisher publisher_;
  ros::WallTimer timer_;
};

}  // namespace trident::bridges
