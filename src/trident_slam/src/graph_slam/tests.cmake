# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
trident_slam_test(graph_slam test/graph_slam/bare_corridor_test.cpp
                  test/graph_slam/beam_patterns_test.cpp test/graph_slam/graph_slam_2d_test.cpp
                  test/graph_slam/keyframe_map_test.cpp test/graph_slam/lifelong_test.cpp
                  test/graph_slam/no_odometry_test.cpp
                  test/graph_slam/live_graph_test.cpp
                  test/graph_slam/session_file_test.cpp)
target_compile_definitions(trident_slam_graph_slam_test PRIVATE
  GRAPH_SLAM_CONFIG="${CMAKE_SOURCE_DIR}/config/slam/graph_slam_2d.yaml"
  SLAM_MANUAL="${CMAKE_SOURCE_DIR}/docs/howto/slam.md")
