#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Node mavlink_demo of trident_eval."""

import sys

from trident_eval.mavlink.demo import main

sys.exit(main())
