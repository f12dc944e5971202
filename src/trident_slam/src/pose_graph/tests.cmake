# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
trident_slam_test(pose_graph
  test/pose_graph/block_cholesky_test.cpp
  test/pose_graph/edge_model_test.cpp
  test/pose_graph/g2o_file_test.cpp
  test/pose_graph/pose_graph_optimizer_test.cpp
)
