# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
trident_slam_test(ekf_slam
  test/ekf_slam/chi_squared_test.cpp
  test/ekf_slam/ekf_slam_test.cpp
  test/ekf_slam/joint_compatibility_test.cpp
  test/ekf_slam/landmark_log_test.cpp
  test/ekf_slam/landmark_models_test.cpp
  test/ekf_slam/posts_test.cpp
)
