#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Node waypoint_flight of trident_fleet."""

import sys

from trident_fleet.nodes.waypoint_flight import main

sys.exit(main())
