# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Sweeps: many seeded runs of a function or a launch file, each a process of its own."""
