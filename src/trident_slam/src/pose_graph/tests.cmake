# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
trident_slam_test(pose_graph
  test/pose_graph/block_cholesky_test.cpp
  test/pose_graph/edge_model_test.cpp
  test/pose_graph/g2o_file_test.cpp
  test/pose_graph/incremental_pose_graph_test.cpp
  test/pose_graph/pose_graph_optimizer_test.cpp
)
# Ceres, apart as its library is.
trident_slam_test(pose_graph_ceres test/pose_graph/ceres_solver_test.cpp)
target_link_libraries(trident_slam_pose_graph_ceres_test trident_slam_ceres)
