# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
# With poses from outside, which both of the methods that can be placed refuse.
trident_slam_test(hector_slam test/hector_slam/map_match_test.cpp test/graph_slam/start_pose_test.cpp
                  test/conformance/scan_world.cpp)
