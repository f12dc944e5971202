#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Node slam_tour."""

import sys

from trident_benchmarks.datasets.tour_node import main

sys.exit(main())
