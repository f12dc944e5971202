#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Node waypoint_path of trident_nav."""

import sys

from trident_nav.nodes.waypoint_path import main

sys.exit(main())
