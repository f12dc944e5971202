# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
# graph_slam_2d: the state machine, its graph, and what is done with both.
find_package(Threads REQUIRED)
target_sources(trident_slam PRIVATE
  src/graph_slam/local/calibrated_odometry.cpp
  src/graph_slam/backend/final_match.cpp
  src/graph_slam/graph_mapper.cpp
  src/graph_slam/graph_mapper_deskew.cpp
  src/graph_slam/graph_mapper_edit.cpp
  src/graph_slam/graph_mapper_motion.cpp
  src/graph_slam/graph_mapper_session.cpp
  src/graph_slam/graph_slam_options.cpp
  src/graph_slam/backend/keyframe_graph.cpp
  src/graph_slam/map/keyframe_map.cpp
  src/graph_slam/loop/loop_closer.cpp
  src/graph_slam/loop/loop_worker.cpp
  src/graph_slam/loop/lost_robot.cpp
  src/graph_slam/backend/pair_linker.cpp
  src/graph_slam/loop/place.cpp
  src/graph_slam/local/pose_uncertainty.cpp
  src/graph_slam/local/recent_scans.cpp
  src/graph_slam/loop/relocalizer.cpp
  src/graph_slam/local/scan_archive.cpp
  src/graph_slam/local/scan_tracker.cpp
  src/graph_slam/session/session_file.cpp
  src/graph_slam/local/submap_matcher.cpp
  src/graph_slam/backend/stale_scans.cpp
)
target_link_libraries(trident_slam PRIVATE Threads::Threads)

add_executable(slam_session src/graph_slam/session/slam_session.cpp)
target_link_libraries(slam_session trident_slam Threads::Threads)
set_target_properties(slam_session PROPERTIES
  RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
install(TARGETS slam_session RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
