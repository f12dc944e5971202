# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""rospy wrappers: parameters, topics and services in, calls of the core, set-points out."""
