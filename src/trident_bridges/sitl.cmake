# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
# The room `sitl`: the simulator's ends of PX4's and ArduPilot's simulator interfaces, without sockets or clocks.
trident_bridges_room(sitl
  src/sitl/ardupilot_link.cpp
  src/sitl/px4_link.cpp
)
add_dependencies(trident_bridges_sitl trident_bridges_mavlink_headers)
target_link_libraries(trident_bridges_sitl PUBLIC trident_bridges_mavlink)
trident_bridges_test(sitl test/sitl/ardupilot_link_test.cpp test/sitl/px4_link_test.cpp)
