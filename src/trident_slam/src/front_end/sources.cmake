# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
# Scan matching: what a scan is compared with, and how.
target_sources(trident_slam PRIVATE
  src/front_end/beam_counts.cpp
  src/front_end/calibrated_motion.cpp
  src/front_end/correlative_match.cpp
  src/front_end/line_match.cpp
  src/front_end/line_scan_matchers.cpp
  src/front_end/map_match.cpp
  src/front_end/max_pyramid.cpp
  src/front_end/motion_filter.cpp
  src/front_end/motion_source.cpp
  src/front_end/ndt_match.cpp
  src/front_end/newton_scan_matchers.cpp
  src/front_end/odometry_calibration.cpp
  src/front_end/odometry_motion.cpp
  src/front_end/odometry_watch.cpp
  src/front_end/point_scan.cpp
  src/front_end/pose_newton.cpp
  src/front_end/probability_grid.cpp
  src/front_end/scan_matcher.cpp
  src/front_end/scan_motion.cpp
  src/front_end/scan_odometry.cpp
  src/front_end/surface_information.cpp
  src/front_end/surfel_map.cpp
  src/front_end/sweep_motion.cpp
)
