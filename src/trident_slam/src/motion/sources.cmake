# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
# Motion between scans: odometry and its calibration, and the scans' own.
target_sources(trident_slam PRIVATE
  src/motion/calibrated_motion.cpp
  src/motion/motion_filter.cpp
  src/motion/motion_source.cpp
  src/motion/odometry_calibration.cpp
  src/motion/odometry_motion.cpp
  src/motion/odometry_watch.cpp
  src/motion/scan_motion.cpp
  src/motion/scan_odometry.cpp
  src/motion/sweep_motion.cpp
)
