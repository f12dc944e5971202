# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Python side of gazebo_ros: clients of the simulator's services."""
