# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
# graph_slam_2d: front end (local), back end (backend, loop), sessions and map.
find_package(Threads REQUIRED)
target_sources(trident_slam PRIVATE
  src/graph_slam/backend/final_match.cpp
  src/graph_slam/backend/keyframe_graph.cpp
  src/graph_slam/backend/pose_graph_backend.cpp
  src/graph_slam/backend/scan_pair_edges.cpp
  src/graph_slam/backend/scan_pruner.cpp
  src/graph_slam/graph_mapper.cpp
  src/graph_slam/graph_slam_options.cpp
  src/graph_slam/local/calibrated_odometry.cpp
  src/graph_slam/local/local_mapper.cpp
  src/graph_slam/local/pose_uncertainty.cpp
  src/graph_slam/local/recent_scans.cpp
  src/graph_slam/local/scan_archive.cpp
  src/graph_slam/local/scan_deskewer.cpp
  src/graph_slam/local/scan_tracker.cpp
  src/graph_slam/local/submap_matcher.cpp
  src/graph_slam/loop/kidnap_detector.cpp
  src/graph_slam/loop/loop_closer.cpp
  src/graph_slam/loop/loop_worker.cpp
  src/graph_slam/loop/place.cpp
  src/graph_slam/loop/relocalizer.cpp
  src/graph_slam/map/keyframe_map.cpp
  src/graph_slam/session/map_editor.cpp
  src/graph_slam/session/session.cpp
  src/graph_slam/session/session_file.cpp
)
target_link_libraries(trident_slam PRIVATE Threads::Threads)

add_executable(slam_session src/graph_slam/session/slam_session.cpp)
target_link_libraries(slam_session trident_slam Threads::Threads)
set_target_properties(slam_session PROPERTIES
  RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
install(TARGETS slam_session RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
