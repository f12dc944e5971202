# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""All rows of `./trident bench bridges`; each protocol has a file of its own."""

from __future__ import annotations

from trident_benchmarks.bridges.rows import ROWS as COMPARED_ROWS
from trident_benchmarks.bridges.rows import Row
from trident_benchmarks.bridges.rows_codec import CODEC_ROWS
from trident_benchmarks.bridges.rows_fleet import FLEET_ROWS
from trident_benchmarks.bridges.rows_mavlink import MAVLINK_ROWS
from trident_benchmarks.bridges.rows_modbus import MODBUS_ROWS
from trident_benchmarks.bridges.rows_nmea import NMEA_ROWS

ROWS: tuple[Row, ...] = (
    *COMPARED_ROWS,
    *MAVLINK_ROWS,
    *NMEA_ROWS,
    *MODBUS_ROWS,
    *CODEC_ROWS,
    *FLEET_ROWS,
)
