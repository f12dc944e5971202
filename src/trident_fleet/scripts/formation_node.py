#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Formation node of one vehicle."""

import sys

from trident_fleet.nodes.main import main_one

sys.exit(main_one())
