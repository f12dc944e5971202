// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/nmea/link_diagnostics.h"

#include <diagnostic_msgs/DiagnosticArray.h>

#include <string>

#include "trident_ros/diagnostic_counter.h"

namespace trident::bridges {
namespace {

constexpr double kPeriodS = 1.0;  ///< wall time

diagnostic_msgs::DiagnosticStatus status_of(const NmeaLink& link) {
  diagnostic_msgs::DiagnosticStatus status;
  status.name = ros::this_node::getName().substr(1) + ": " + link.name();
  status.message = "counts";
  const EndpointCounts carried = link.counts();
  const nmea::FramerCounts framed = link.framed();
  const auto add = [&](const char* key, std::uint64_t value) {
    status.values.push_back(ros_utils::key_value(key, std::to_string(value)));
  };
  add("sent_bytes", carried.sent_bytes);
  add("received_bytes", carried.received_bytes);
  add("cut", carried.cut);
  add("refused_peers", carried.refused_peers);
  add("sentences", framed.sentences);
  add("skipped_bytes", framed.skipped);
  return status;
}

}  // namespace

LinkDiagnostics::LinkDiagnostics(ros::NodeHandle& node,
                                 const std::vector<std::unique_ptr<NmeaLink>>& links)
    : links_(links),
      publisher_(node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10)),
      timer_(node.createWallTimer(ros::WallDuration(kPeriodS),
                                  [this](const ros::WallTimerEvent&) { publish(); })) {}

void LinkDiagnostics::publish() {
  if (publisher_.getNumSubscribers() == 0) return;
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = ros::Time::now();
  for (const auto& link : links_) array.status.push_back(status_of(*link));
  publisher_.publish(array);
}

}  // namespace trident::bridges
