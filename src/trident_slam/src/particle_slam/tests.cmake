# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
trident_slam_test(particle_slam
  test/particle_slam/particle_slam_test.cpp
  test/conformance/scan_world.cpp
)
