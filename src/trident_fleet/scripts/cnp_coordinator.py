#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Contract net: a robot or a manager of a team that shares out tasks."""

import sys

from trident_fleet.nodes.tasks.coordinator import main

sys.exit(main())
