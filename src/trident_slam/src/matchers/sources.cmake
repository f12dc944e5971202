# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
# Scan matchers.
target_sources(trident_slam PRIVATE
  src/matchers/correlative_match.cpp
  src/matchers/line_match.cpp
  src/matchers/map_match.cpp
  src/matchers/ndt_match.cpp
  src/matchers/pose_newton.cpp
  src/matchers/scan_matcher.cpp
  src/matchers/surface_information.cpp
)
