# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
# graph_slam_2d: the state machine, its graph, and what is done with both.
find_package(Threads REQUIRED)
target_sources(trident_slam PRIVATE
  src/graph_slam/calibrated_odometry.cpp
  src/graph_slam/final_match.cpp
  src/graph_slam/graph_mapper.cpp
  src/graph_slam/graph_mapper_deskew.cpp
  src/graph_slam/graph_mapper_edit.cpp
  src/graph_slam/graph_mapper_motion.cpp
  src/graph_slam/graph_mapper_session.cpp
  src/graph_slam/graph_slam_2d.cpp
  src/graph_slam/graph_slam_options.cpp
  src/graph_slam/keyframe_graph.cpp
  src/graph_slam/keyframe_map.cpp
  src/graph_slam/loop_closer.cpp
  src/graph_slam/loop_worker.cpp
  src/graph_slam/lost_robot.cpp
  src/graph_slam/pair_linker.cpp
  src/graph_slam/place.cpp
  src/graph_slam/pose_uncertainty.cpp
  src/graph_slam/recent_scans.cpp
  src/graph_slam/relocalizer.cpp
  src/graph_slam/scan_archive.cpp
  src/graph_slam/scan_check.cpp
  src/graph_slam/scan_tracker.cpp
  src/graph_slam/session_file.cpp
  src/graph_slam/start_pose.cpp
  src/graph_slam/submap_matcher.cpp
  src/graph_slam/stale_scans.cpp
)
target_link_libraries(trident_slam PRIVATE Threads::Threads)

add_executable(slam_live src/graph_slam/slam_live.cpp)
add_executable(slam_session src/graph_slam/slam_session.cpp)
foreach(program slam_live slam_session)
  target_link_libraries(${program} trident_slam Threads::Threads)
  set_target_properties(${program} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
  install(TARGETS ${program} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
endforeach()
