# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
# The room `nmea`: NMEA 0183 without ROS, sockets or clocks.
trident_bridges_room(nmea
  src/nmea/ais_six_bit.cpp
  src/nmea/ais_target_table.cpp
  src/nmea/ais_transmitter.cpp
  src/nmea/all_sentences.cpp
  src/nmea/field_reader.cpp
  src/nmea/field_values.cpp
  src/nmea/field_writer.cpp
  src/nmea/gnss_talker.cpp
  src/nmea/guidance_talker.cpp
  src/nmea/instrument_reader.cpp
  src/nmea/instrument_talker.cpp
  src/nmea/navsat_reader.cpp
  src/nmea/receiver.cpp
  src/nmea/refusal.cpp
  src/nmea/replay_pacer.cpp
  src/nmea/sentence.cpp
  src/nmea/sentence_checks.cpp
  src/nmea/sentence_framer.cpp
  src/nmea/sentence_sender.cpp
  src/nmea/steering_reader.cpp
  src/nmea/utc_resolver.cpp
)
trident_bridges_test(nmea
  test/nmea/ais_test.cpp
  test/nmea/fuzz_test.cpp
  test/nmea/guidance_test.cpp
  test/nmea/receiver_test.cpp
  test/nmea/replay_test.cpp
  test/nmea/sentence_framer_test.cpp
  test/nmea/sentences_test.cpp
  test/nmea/talker_test.cpp
)
if(CATKIN_ENABLE_TESTING)
  # Alone, because it replaces malloc.
  catkin_add_gtest(trident_bridges_nmea_allocation_test test/nmea/allocation_test.cpp)
  target_include_directories(trident_bridges_nmea_allocation_test PRIVATE test)
  target_link_libraries(trident_bridges_nmea_allocation_test trident_bridges_nmea trident_base_test_support gtest_main)
endif()

add_executable(nmea_codec_bench benchmark/nmea_codec_bench.cpp)
target_link_libraries(nmea_codec_bench PRIVATE trident_bridges_nmea)
install(TARGETS nmea_codec_bench RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})

add_executable(nmea_replay programs/nmea_replay.cpp)
target_link_libraries(nmea_replay PRIVATE trident_bridges_nmea trident_bridges_transport)
install(TARGETS nmea_replay RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
