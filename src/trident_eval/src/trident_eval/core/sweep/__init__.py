# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Sweeps without processes: scenarios, their runs, statistics, tables and pages."""
