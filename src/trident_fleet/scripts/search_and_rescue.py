#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Node of a team that searches and rescues."""

import sys

from trident_fleet.nodes.search.main import main

sys.exit(main())
