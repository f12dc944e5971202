# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
# Occupancy grids, max pyramids and surfel maps that scans are matched with.
target_sources(trident_slam PRIVATE
  src/grids/beam_counts.cpp
  src/grids/max_pyramid.cpp
  src/grids/probability_grid.cpp
  src/grids/surfel_map.cpp
)
