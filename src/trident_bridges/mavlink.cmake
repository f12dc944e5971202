# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0

# --- the dialect's C headers, made at build time --------------------------------------------------
set(mavlink_generated "${CMAKE_CURRENT_BINARY_DIR}/mavlink")
set(mavlink_python "${CMAKE_SOURCE_DIR}/.venv/bin/python")
if(NOT EXISTS "${mavlink_python}")
  set(mavlink_python "${PYTHON_EXECUTABLE}")
endif()
add_custom_command(
  OUTPUT "${mavlink_generated}/trident_message_list.h"
  COMMAND "${mavlink_python}" "${CMAKE_CURRENT_SOURCE_DIR}/dialect/generate.py" "${mavlink_generated}"
  DEPENDS dialect/generate.py dialect/trident.xml "${CMAKE_SOURCE_DIR}/tools/requirements.txt"
  COMMENT "MAVLink headers from dialect/trident.xml"
  VERBATIM)
add_custom_target(trident_bridges_mavlink_headers DEPENDS "${mavlink_generated}/trident_message_list.h")

# --- codec and protocol state machines ------------------------------------------------------------
trident_bridges_room(mavlink
  src/mavlink/checksum.cpp
  src/mavlink/command_client.cpp
  src/mavlink/command_server.cpp
  src/mavlink/heartbeat_monitor.cpp
  src/mavlink/message_json.cpp
  src/mavlink/message_streams.cpp
  src/mavlink/message_table.cpp
  src/mavlink/mission.cpp
  src/mavlink/mission_client.cpp
  src/mavlink/mission_messages.cpp
  src/mavlink/mission_server.cpp
  src/mavlink/mission_server_uploads.cpp
  src/mavlink/packet.cpp
  src/mavlink/packet_parser.cpp
  src/mavlink/packet_writer.cpp
  src/mavlink/parameter_client.cpp
  src/mavlink/parameter_server.cpp
  src/mavlink/router.cpp
  src/mavlink/sequence_tracker.cpp
  src/mavlink/signing.cpp
  src/mavlink/signing_file.cpp
  src/mavlink/small_services.cpp
  src/mavlink/status_text.cpp
  src/mavlink/timesync.cpp
  src/mavlink/tlog.cpp
  src/mavlink/vehicles.cpp
)
add_dependencies(trident_bridges_mavlink trident_bridges_mavlink_headers)
target_include_directories(trident_bridges_mavlink SYSTEM PUBLIC "$<BUILD_INTERFACE:${mavlink_generated}>")

foreach(program mavlink_decode mavlink_codec_bench mavlink_vehicles)
  add_executable(${program} programs/${program}.cpp)
  target_compile_options(${program} PRIVATE -Wall -Wextra)
  target_link_libraries(${program} trident_bridges_mavlink)
  set_target_properties(${program} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
  install(TARGETS ${program} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
endforeach()

trident_bridges_test(mavlink
  test/mavlink/command_test.cpp
  test/mavlink/frames_test.cpp
  test/mavlink/mission_test.cpp
  test/mavlink/packet_fuzz_test.cpp
  test/mavlink/packet_parser_test.cpp
  test/mavlink/packets.cpp
  test/mavlink/parameter_test.cpp
  test/mavlink/router_test.cpp
  test/mavlink/services_test.cpp
  test/mavlink/signing_test.cpp
  test/mavlink/vehicles_test.cpp
)
if(CATKIN_ENABLE_TESTING AND COMMAND trident_add_pytest)
  trident_add_pytest(trident_bridges_mavlink_pymavlink test/mavlink)
endif()
