# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
# The room `vehicle`: what a simulated vehicle says and understands in MAVLink, without ROS, sockets or clocks.
find_package(PkgConfig REQUIRED)
pkg_check_modules(GEOGRAPHICLIB REQUIRED IMPORTED_TARGET geographiclib)
trident_bridges_room(vehicle
  src/vehicle/commands.cpp
  src/vehicle/geo_frame.cpp
  src/vehicle/mavlink_vehicle.cpp
  src/vehicle/mavlink_vehicle_missions.cpp
  src/vehicle/missions.cpp
  src/vehicle/status_telemetry.cpp
  src/vehicle/sensor_telemetry.cpp
  src/vehicle/setpoint_telemetry.cpp
  src/vehicle/sticks.cpp
  src/vehicle/targets.cpp
  src/vehicle/telemetry.cpp
)
add_dependencies(trident_bridges_vehicle trident_bridges_mavlink_headers)
target_link_libraries(trident_bridges_vehicle PUBLIC trident_bridges_autopilot trident_bridges_mavlink
  PkgConfig::GEOGRAPHICLIB)
add_executable(mavlink_parameters programs/mavlink_parameters.cpp)
target_compile_options(mavlink_parameters PRIVATE -Wall -Wextra)
target_link_libraries(mavlink_parameters trident_bridges_autopilot)
set_target_properties(mavlink_parameters PROPERTIES
  RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
install(TARGETS mavlink_parameters RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
trident_bridges_test(vehicle
  test/mavlink/packets.cpp
  test/vehicle/commands_test.cpp
  test/vehicle/mavlink_vehicle_test.cpp
  test/vehicle/random_messages_test.cpp
  test/vehicle/targets_test.cpp
  test/vehicle/telemetry_test.cpp
)
