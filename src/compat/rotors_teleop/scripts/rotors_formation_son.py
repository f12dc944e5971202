#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Formation node of one vehicle under the name and with the parameters that tutorials use."""

import sys

from trident_fleet.nodes.main import main_one

# In those launch files hovering_example commands the same vehicles.
sys.exit(main_one(guard=True))
