// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nmea_msgs/Sentence.h>
#include <ros/ros.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "trident_base/utc_clock.h"
#include "trident_bridges/nmea/send/sentence_sender.h"
#include "trident_bridges_ros/nmea/ais_exchange.h"
#include "trident_bridges_ros/nmea/instrument_output.h"
#include "trident_bridges_ros/nmea/link_diagnostics.h"
#include "trident_bridges_ros/nmea/nmea_link.h"
#include "trident_bridges_ros/nmea/nmea_node_params.h"
#include "trident_bridges_ros/nmea/route_exchange.h"
#include "trident_bridges_ros/nmea/vehicle_input.h"
#include "trident_bridges_ros/node_poll_loop.h"
#include "trident_bridges_ros/node_publisher.h"
#include "trident_ros/refusals.h"

namespace trident::bridges {

/// A vehicle's instruments as an NMEA 0183 device: what topics say is sent on all links that send,
/// and what comes on those that listen is published below `output`. What is wrong with what comes
/// is logged with link, peer, field, value and legal range, and counted on /diagnostics.
class NmeaNode : public nmea::TalkerSink {
 public:
  /// Opens the links and subscribes below `node`'s namespace; `clock` says which UTC simulated time
  /// is. Throws Error naming a parameter or URL.
  NmeaNode(ros::NodeHandle& node, NodePollLoop& loop, const NmeaNodeParams& params,
           const UtcClock& clock);
  ~NmeaNode() override;

  void on_sentence(std::string_view sentence, SimTime stamp) override;
  void on_problem(std::string_view type, const nmea::Refusal& refusal) override;

 private:
  void open(ros::NodeHandle& node, const NmeaLinkParams& link, const NmeaNodeParams& params);
  void open_ais(ros::NodeHandle& node, const NmeaNodeParams& params);
  VehicleHooks vehicle_hooks();
  nmea::Receipt receive();
  void pass_on(const nmea::Sentence& sentence);

  NodePollLoop& loop_;
  UtcClock clock_;
  ros::NodeHandle rare_;  ///< whose callbacks the loop calls
  ros_utils::Refusals refusals_;
  InstrumentOutput output_;
  NodePublisher<nmea_msgs::Sentence> sentences_;
  nmea_msgs::Sentence message_;
  nmea::SentenceSender sender_;
  RouteExchange routes_;
  std::vector<std::unique_ptr<NmeaLink>> links_;
  std::vector<NmeaLink*> senders_;  ///< those that send
  std::unique_ptr<AisExchange> ais_;
  std::unique_ptr<VehicleInput> input_;
  LinkDiagnostics diagnostics_;
};

}  // namespace trident::bridges
