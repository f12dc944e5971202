# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
# The room `nmea`: NMEA 0183 without ROS, sockets or clocks.
trident_bridges_room(nmea
  src/nmea/ais_six_bit.cpp
  src/nmea/ais_target_table.cpp
  src/nmea/all_sentences.cpp
  src/nmea/field_reader.cpp
  src/nmea/field_values.cpp
  src/nmea/field_writer.cpp
  src/nmea/instrument_reader.cpp
  src/nmea/navsat_reader.cpp
  src/nmea/receiver.cpp
  src/nmea/refusal.cpp
  src/nmea/sentence.cpp
  src/nmea/sentence_checks.cpp
  src/nmea/sentence_framer.cpp
  src/nmea/steering_reader.cpp
  src/nmea/utc_resolver.cpp
)
trident_bridges_test(nmea
  test/nmea/ais_test.cpp
  test/nmea/receiver_test.cpp
  test/nmea/sentence_framer_test.cpp
  test/nmea/sentences_test.cpp
)
