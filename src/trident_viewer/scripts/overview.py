#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Node overview."""

import sys

from trident_viewer.overview import main

sys.exit(main())
