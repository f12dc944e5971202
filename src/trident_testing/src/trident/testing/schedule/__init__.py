# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Runs under schedules that a machine at rest never sees: whether their state hash stays equal.

Processes are delayed at their hand-overs and stopped for up to 15 s. As a program:
`python3 -m trident.testing.schedule --help`.
"""
