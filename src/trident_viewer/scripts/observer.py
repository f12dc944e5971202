#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Node observer."""

import sys

from trident_viewer.observer import main

sys.exit(main())
