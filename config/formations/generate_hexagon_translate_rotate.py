#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Writes hexagon_translate_rotate.txt: six vehicles, 200 rows, interleaved vehicle by vehicle.

A line along y becomes a hexagon, the hexagon moves ahead, turns by half a turn without changing its
shape, and moves on. Units are metres: fly it with scale 1 1 1 and offset 0 0 0.

    ./generate_hexagon_translate_rotate.py > hexagon_translate_rotate.txt
"""

from __future__ import annotations

import math
import sys

ROWS = 200
LINE_Y_M = (4.0, 2.4, 0.8, -0.8, -2.4, -4.0)
RADIUS_M = 1.7
# Slots around the hexagon in the order of the line, so that no two paths cross.
SLOT_DEG = (90.0, 150.0, 30.0, 210.0, 330.0, 270.0)
START_Z_M = 1.2
# (first row, last row, shift [m], turn [deg]); the first phase forms the hexagon.
FORM = (0, 45)
PHASES = (
    (0, 45, (2.0, 0.0, 0.3), 0.0),
    (45, 105, (7.0, 1.5, 0.0), 0.0),
    (105, 155, (0.0, 0.0, 0.0), 180.0),
    (155, 199, (3.0, 4.0, -0.2), 0.0),
)


def blend(row: int, first: int, last: int) -> float:
    """Share of a phase that is done at a row, 0 to 1, with a smooth beginning and end."""
    part = min(max((row - first) / (last - first), 0.0), 1.0)
    return part * part * (3.0 - 2.0 * part)


def position(row: int, vehicle: int) -> tuple[float, float, float]:
    """Position of a vehicle at a row [m]."""
    center, turn_deg = [0.0, 0.0, START_Z_M], 0.0
    for first, last, shift, angle_deg in PHASES:
        done = blend(row, first, last)
        center = [c + done * w for c, w in zip(center, shift, strict=True)]
        turn_deg += done * angle_deg
    formed = blend(row, *FORM)
    slot = math.radians(SLOT_DEG[vehicle])
    x = formed * RADIUS_M * math.cos(slot)
    y = (1.0 - formed) * LINE_Y_M[vehicle] + formed * RADIUS_M * math.sin(slot)
    turn = math.radians(turn_deg)
    return (
        center[0] + x * math.cos(turn) - y * math.sin(turn),
        center[1] + x * math.sin(turn) + y * math.cos(turn),
        center[2],
    )


def main() -> None:
    """Write all rows to standard output."""
    vehicles = len(LINE_Y_M)
    lines = [
        "% SPDX-FileCopyrightText: 2026 The Trident authors",
        "% SPDX-License-Identifier: Apache-2.0",
        "% six vehicles, 200 rows, metres: line, hexagon, translation, half a turn, translation",
        "% index\tx\ty\tz",
    ]
    for row in range(ROWS):
        for vehicle in range(vehicles):
            x, y, z = (round(value, 6) + 0.0 for value in position(row, vehicle))
            lines.append(f"{row * vehicles + vehicle + 1}\t{x:.6f}\t{y:.6f}\t{z:.6f}")
    sys.stdout.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
