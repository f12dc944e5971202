#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Node navigate."""

import sys

from trident_benchmarks.nav.drive_node import main

sys.exit(main())
