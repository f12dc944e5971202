// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// nmea_navsat_driver's nodes: their parameters and main functions.
#pragma once

#include <string>

#include "trident_base/config_types.h"
#include "trident_bridges/nmea/receive/navsat_reader.h"

namespace trident::bridges {

/// What nmea_navsat_driver's nodes that publish fixes read.
struct NavsatDriverParams {
  std::string frame_id = "gps";  ///< below a tf_prefix, if there is one
  bool uses_gnss_time = false;   ///< stamps fixes with the receiver's time
  std::string time_ref_source;   ///< "": frame_id
  bool enu_heading = false;      ///< heading as REP-103 has yaw; upstream's is the compass' angle
  nmea::NavsatParams navsat;     ///< upstream's

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("frame_id", frame_id, "of all messages, below the tf_prefix if there is one");
    ar.field("use_GNSS_time", uses_gnss_time, "stamps fixes with the time of the receiver");
    ar.field("time_ref_source", time_ref_source, "of time_reference; empty: frame_id");
    ar.field("enu_heading", enu_heading,
             "heading counter-clockwise from east; false: upstream's, clockwise from north");
    navsat.visit(ar);
  }
};

/// A serial line, as nmea_navsat_driver has it.
struct NavsatSerialParams {
  std::string port = "/dev/ttyUSB0";  ///< device
  int baud = 4800;                    ///< [bit/s]

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("port", port, "device");
    ar.field("baud", baud, Range{50, 4'000'000}, "[bit/s]");
  }
};

/// A UDP socket, as nmea_navsat_driver has it, but on the loopback interface.
struct NavsatSocketParams {
  std::string ip = "127.0.0.1";  ///< upstream's is 0.0.0.0
  int port = 10110;              ///< that is bound
  int buffer_size = 4096;        ///< not used, as upstream
  double timeout_s = 2.0;        ///< not used: nothing waits

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("ip", ip, "address that is bound; upstream binds 0.0.0.0, which is all interfaces");
    ar.field("port", port, Range{1, 65'535}, "that is bound");
    ar.field("buffer_size", buffer_size, Range::positive(), "taken, without an effect");
    ar.field("timeout_sec", timeout_s, Range::positive(), "taken, without an effect [s]");
  }
};

/// Reads a serial line and publishes `fix`, `vel`, `heading`, `time_reference`; an exit code.
int nmea_serial_driver_main(int argc, char** argv);
/// The same with the sentences of the topic `nmea_sentence`.
int nmea_topic_driver_main(int argc, char** argv);
/// The same with the datagrams of a UDP socket.
int nmea_socket_driver_main(int argc, char** argv);
/// Publishes the sentences of a serial line on `nmea_sentence`.
int nmea_topic_serial_reader_main(int argc, char** argv);

}  // namespace trident::bridges
