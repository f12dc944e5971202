# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Judges trajectories and maps: relations, ATE, RPE, map agreement; and the SLAM benchmark."""
