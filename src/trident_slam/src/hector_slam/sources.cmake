# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
target_sources(trident_slam PRIVATE src/hector_slam/hector_slam_2d.cpp)
