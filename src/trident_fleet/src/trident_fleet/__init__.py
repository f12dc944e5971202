# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Several robots as one team. `core` is free of ROS, `nodes` are thin rospy wrappers."""
