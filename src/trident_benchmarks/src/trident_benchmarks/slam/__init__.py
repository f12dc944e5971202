# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""SLAM on public logs, in simulated worlds, and while a graph is optimised."""
