#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The old name of a node of trident_benchmarks."""

from trident_eval.moved_node import start_moved_node

start_moved_node("trident_benchmarks")
