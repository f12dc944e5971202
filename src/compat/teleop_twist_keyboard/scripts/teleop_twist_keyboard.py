#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Drives a robot over cmd_vel from the keys of a terminal."""

import sys

from keyboard_teleop.node import main

sys.exit(main())
