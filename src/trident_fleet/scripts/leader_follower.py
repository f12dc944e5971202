#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Followers of a leader whose odometry or pose comes from a live topic."""

import sys

from trident_fleet.nodes.leader_follower import main

sys.exit(main())
