# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
trident_slam_test(front_end
  test/front_end/match_derivatives_test.cpp
  test/front_end/motion_filter_test.cpp
  test/front_end/odometry_calibration_test.cpp
  test/front_end/point_scan_test.cpp
  test/front_end/scan_matcher_conformance_test.cpp
  test/front_end/scan_motion_test.cpp
  test/front_end/sweep_motion_test.cpp
)
