// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nmea_msgs/Sentence.h>
#include <ros/ros.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "trident_bridges/nmea/send/ais_transmitter.h"
#include "trident_bridges_ros/nmea/sentence_reader.h"
#include "trident_bridges_ros/node_poll_loop.h"
#include "trident_bridges_ros/node_publisher.h"

namespace trident::bridges {

/// How vessels hear each other.
struct AisExchangeParams : nmea::AisParams {
  std::string topic = "/vhf/ais";  ///< nmea_msgs/Sentence: a whole message each
  double range_m = 40'000.0;       ///< of VHF

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    AisParams::visit(ar);
    ar.field("topic", topic, "nmea_msgs/Sentence, common to all vessels: what stations send");
    ar.field("range", range_m, Range::positive(),
             "of VHF: stations further away are not heard [m]");
  }
};

/// What an AisExchange hands on.
struct AisExchangeHooks {
  std::function<void(std::string_view sentences)> to_links;  ///< VDO of its own, VDM of others
  nmea::ReceiverSink* output = nullptr;                      ///< other vessels
  ros_utils::Refusals* refusals = nullptr;
};

/// A vessel's AIS station on a topic that stands for the VHF channels: what it sends goes there
/// and, as VDO, to its links; what others in range send comes to its links as VDM, and as messages.
class AisExchange : nmea::AisSink, nmea::ReceiverSink {
 public:
  /// The references, and what `hooks` point to, outlive the exchange.
  AisExchange(ros::NodeHandle& node, NodePollLoop& loop, const AisExchangeParams& params,
              const UtcClock& clock, AisExchangeHooks hooks);

  /// Sends what is due.
  void on_state(SimTime stamp, const nmea::AisState& state);

 private:
  void on_part(const nmea::AisPart& part, SimTime stamp) override;
  void on_ais(const nmea::AisVessel& vessel, bool is_own) override;
  void hear(const nmea_msgs::Sentence& message);
  bool is_in_range(const nmea::AisVessel& vessel) const;

  AisExchangeParams params_;
  AisExchangeHooks hooks_;
  nmea::AisTransmitter transmitter_;
  NodePublisher<nmea_msgs::Sentence> channel_;
  nmea_msgs::Sentence message_;
  NmeaReadHooks reading_;
  std::unique_ptr<SentenceReader> reader_;
  std::string_view heard_;                 ///< the message that is read now
  std::optional<nmea::RoutePlace> place_;  ///< of the vessel itself
  std::unique_ptr<ros_utils::DirectSubscription> subscription_;
};

}  // namespace trident::bridges
