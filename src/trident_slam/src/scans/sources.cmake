# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
# Scans: their points, what is wrong with them, their archive, where they begin.
target_sources(trident_slam PRIVATE
  src/scans/point_scan.cpp
  src/scans/scan_check.cpp
  src/scans/start_pose.cpp
)
