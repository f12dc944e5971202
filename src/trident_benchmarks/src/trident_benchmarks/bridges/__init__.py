# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Latency and throughput of bridges between ROS and other protocols."""
