#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Base station of the air: a UAV that flies to where radio links are best."""

import sys

from trident_fleet.nodes.base_station import main

sys.exit(main())
