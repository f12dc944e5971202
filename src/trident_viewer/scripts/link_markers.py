#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Node link_markers."""

import sys

from trident_viewer.link_markers import main

sys.exit(main())
