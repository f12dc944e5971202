# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
find_package(BZip2 REQUIRED)
find_package(ZLIB REQUIRED)
target_sources(trident_slam PRIVATE
  src/logs/carmen_log.cpp
  src/logs/fields.cpp
  src/logs/line_reader.cpp
  src/logs/offline_program.cpp
  src/logs/offline_run.cpp
  src/logs/process_cost.cpp
  src/logs/scan_map.cpp
  src/logs/scan_source.cpp
  src/logs/stamp_check.cpp
)
target_link_libraries(trident_slam PUBLIC trident_maps PRIVATE BZip2::BZip2 ZLIB::ZLIB)

add_executable(slam_offline src/logs/slam_offline.cpp)
target_link_libraries(slam_offline trident_slam)
set_target_properties(slam_offline PROPERTIES
  RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
install(TARGETS slam_offline RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
