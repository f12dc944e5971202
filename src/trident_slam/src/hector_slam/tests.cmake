# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
trident_slam_test(hector_slam test/hector_slam/map_match_test.cpp test/conformance/scan_world.cpp)
