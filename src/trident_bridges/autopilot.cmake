# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0

find_package(Eigen3 REQUIRED)
trident_bridges_room(autopilot
  src/autopilot/autopilot.cpp
  src/autopilot/autopilot_arming.cpp
  src/autopilot/autopilot_requests.cpp
  src/autopilot/drive_guide.cpp
  src/autopilot/fence.cpp
  src/autopilot/flight_guide.cpp
  src/autopilot/mission.cpp
  src/autopilot/modes.cpp
  src/autopilot/motion.cpp
  src/autopilot/parameter_lists.cpp
  src/autopilot/parameter_table.cpp
  src/autopilot/rover_steering.cpp
  src/autopilot/setpoint_stream.cpp
  src/autopilot/vehicle.cpp
  src/autopilot/watch.cpp
)
target_link_libraries(trident_bridges_autopilot PUBLIC Eigen3::Eigen)
trident_bridges_test(autopilot
  test/autopilot/autopilot_test.cpp test/autopilot/refusals_test.cpp test/autopilot/motion_test.cpp test/autopilot/rover_steering_test.cpp test/autopilot/tables_test.cpp)
