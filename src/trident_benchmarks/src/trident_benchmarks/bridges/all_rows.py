# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""All rows of `./trident bench bridges`; each protocol has a file of its own."""

from __future__ import annotations

from trident_benchmarks.bridges.rows import ROWS as COMPARED_ROWS
from trident_benchmarks.bridges.rows_modbus import MODBUS_ROWS
from trident_benchmarks.bridges.rows_nmea import NMEA_ROWS

ROWS = (*COMPARED_ROWS, *MODBUS_ROWS, *NMEA_ROWS)
