#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Node hold_at."""

import sys

from trident_viewer.hold import main

sys.exit(main())
