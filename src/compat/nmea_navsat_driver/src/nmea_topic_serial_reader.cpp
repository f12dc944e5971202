// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/nmea/navsat_drivers.h"

int main(int argc, char** argv) {
  return trident::bridges::nmea_topic_serial_reader_main(argc, argv);
}
