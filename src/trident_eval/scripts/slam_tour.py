#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Node slam_tour of trident_eval."""

import sys

from trident_eval.slam.tour_node import main

sys.exit(main())
