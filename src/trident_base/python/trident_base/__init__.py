# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What the Python packages of the workspace share. No ROS, nothing beyond the standard library."""
