# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Streams a running simulation to the rerun viewer and into .rrd files."""
