# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Matrices of known positions in every layout that a .mat file may have."""

from __future__ import annotations

import numpy as np
from trident_fleet.core.files.mat_file import LAYOUTS_2D


def positions(steps: int, vehicles: int) -> np.ndarray:
    """A line of vehicles 20 apart that moves by small steps; every value is a byte's."""
    t, v = np.meshgrid(np.arange(steps), np.arange(vehicles), indexing="ij")
    return np.stack([t + 20.0 * v, 2.0 * t + 7.0 * (v % 3) + 1.0, 3.0 * t + v + 2.0], axis=-1)


def laid_out(p: np.ndarray, layout: str) -> np.ndarray:
    if layout in LAYOUTS_2D:
        rows = p.reshape(-1, 3)
        return rows if layout == "TNx3" else rows.T
    return np.transpose(p, ["TN3".index(axis) for axis in layout.split("x")])
