#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Node platform_frames of trident_nav."""

import sys

from trident_nav.nodes.platform_frames import main

sys.exit(main())
