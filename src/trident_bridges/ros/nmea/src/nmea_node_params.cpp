// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/nmea/nmea_node_params.h"

namespace trident::bridges {

EndpointOptions NmeaLinkParams::options() const {
  constexpr std::uint16_t kNmeaPort = 10110;  // IANA: nmea-0183
  constexpr std::uint32_t kNmeaBaud = 4800;   // NMEA 0183 4.11, 3.3
  EndpointOptions result;
  result.url = url;
  result.allow_remote = allow_remote;
  result.default_bind_port = kNmeaPort;
  result.default_port = kNmeaPort;
  result.default_baud = kNmeaBaud;
  result.max_peers = static_cast<std::uint32_t>(max_peers);
  return result;
}

nmea::NavsatParams NmeaNodeParams::exact_navsat() {
  nmea::NavsatParams params;
  params.dop_scales_gst = false;
  return params;
}

NmeaNodeParams read_nmea_params(ros_utils::NodeParams& params) {
  NmeaNodeParams defaults;
  if (const std::optional<ConfigNode> file = params.take("config_file")) {
    if (!file->scalar.empty()) defaults = load_yaml<NmeaNodeParams>(file->scalar);
  }
  return params.read<NmeaNodeParams>(defaults);
}

}  // namespace trident::bridges
