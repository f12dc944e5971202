#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Spawns all vehicles of a fleet."""

import sys

from trident_fleet.nodes.spawn_fleet import main

sys.exit(main())
