// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trident_base/config_types.h"
#include "trident_base/utc_clock.h"
#include "trident_bridges/nmea/receive/receiver.h"
#include "trident_bridges/nmea/send/guidance_talker.h"
#include "trident_bridges/nmea/send/sentence_sender.h"
#include "trident_bridges/nmea/sentence_framer.h"
#include "trident_bridges/transport/endpoint.h"
#include "trident_bridges_ros/nmea/ais_exchange.h"
#include "trident_bridges_ros/nmea/local_frame.h"
#include "trident_ros/node_params.h"

namespace trident::bridges {

/// One connection of nmea_node.
struct NmeaLinkParams {
  std::string url = "tcp-l://:10110";  ///< see transport/url.h; ports that are not given are 10110
  bool sends = true;                   ///< what the vehicle's instruments say
  bool listens = true;                 ///< what comes is read
  bool allow_remote = false;           ///< may bind or connect to what is not loopback
  int max_peers = 16;                  ///< clients of a TCP server, learnt peers of UDP

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field(
        "url", url,
        "udp://, tcp://, tcp-l:// (a server), serial://, pty://, radio:; default port 10110, 4800 "
        "baud");
    ar.field("sends", sends, "whether what the vehicle's instruments say is sent");
    ar.field("listens", listens, "whether what comes is read");
    ar.field("allow_remote", allow_remote, "may bind or connect to what is not loopback");
    ar.field("max_peers", max_peers, Range{1, 1'000}, "clients of a server; more are refused");
  }
  /// How the endpoint is opened.
  EndpointOptions options() const;
};

/// Topics that instruments are read from, relative to the node's namespace; "": has none.
struct NmeaTopicParams {
  std::string fix = "fix";                  ///< sensor_msgs/NavSatFix
  std::string gnss_status = "gnss_status";  ///< trident_msgs/GnssStatus
  std::string odometry = "odometry";        ///< nav_msgs/Odometry: velocity, heading, tilt, turn
  std::string speed_through_water = "speed_through_water";  ///< std_msgs/Float64 [m/s]
  std::string depth = "depth";                              ///< sensor_msgs/Range
  std::string wind = "wind_reading";                        ///< trident_msgs/WindReading
  std::string path = "command/path";                        ///< nav_msgs/Path: the route
  std::string rudder;                                       ///< std_msgs/Float64 [rad]
  std::vector<std::string> shafts;                          ///< std_msgs/Float64 [1/min]

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("fix", fix, "sensor_msgs/NavSatFix");
    ar.field("gnss_status", gnss_status, "trident_msgs/GnssStatus");
    ar.field("odometry", odometry, "nav_msgs/Odometry: speed, heading, tilt, rate of turn");
    ar.field("speed_through_water", speed_through_water, "std_msgs/Float64 [m/s]");
    ar.field("depth", depth, "sensor_msgs/Range below the transducer");
    ar.field("wind", wind, "trident_msgs/WindReading");
    ar.field("path", path, "nav_msgs/Path in the frame of the odometry: the route");
    ar.field("rudder", rudder, "std_msgs/Float64, to port is positive [rad]");
    ar.field("shafts", shafts, "std_msgs/Float64 each: one, or starboard and port in turn [1/min]");
  }
};

/// What nmea_node does with what route planners say.
struct AutopilotParams {
  bool is_on = false;  ///< whether it steers the vehicle
  nmea::SteeringParams steering;

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("steers", is_on, "whether command/heading and command/path are published");
    steering.visit(ar);
  }
};

/// Parameters of nmea_node, private ones or those of ~config_file.
struct NmeaNodeParams {
  std::vector<NmeaLinkParams> links{NmeaLinkParams{}};
  nmea::FramerParams framer;
  nmea::TalkerParams talker;
  nmea::NavsatParams navsat = exact_navsat();
  AutopilotParams autopilot;
  nmea::GuidanceParams guidance;
  AisExchangeParams ais;
  OriginParams origin;
  NmeaTopicParams topics;
  std::string output = "nmea";   ///< namespace of the topics of what is read
  std::string frame_id = "gps";  ///< of these topics

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("links", links, "connections");
    framer.visit(ar);
    talker.visit(ar);
    ar.field("navsat", navsat, "how fixes are read");
    ar.field("autopilot", autopilot, "what is done with autopilot sentences that come");
    ar.field("guidance", guidance, "how a route is followed, for those that are sent");
    ar.field("ais", ais, "the vessel's AIS station");
    ar.field("origin", origin, "where on earth the odometry's origin lies");
    ar.field("topics", topics, "that instruments are read from; empty: has none");
    ar.field("output", output, "namespace of the topics of what is read");
    ar.field("frame_id", frame_id, "frame of these topics");
  }
  /// Throws Error as the parts do.
  void validate() const { talker.validate(); }

 private:
  /// GST's errors are taken as they are.
  static nmea::NavsatParams exact_navsat();
};

/// A node's parameters on top of those of ~config_file, which is a YAML file with the same keys, if
/// it is set. Throws ConfigError with file, line, key, value and legal range.
NmeaNodeParams read_nmea_params(ros_utils::NodeParams& params);

}  // namespace trident::bridges
