# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Matrices of known positions in every layout that a .mat file may have."""

from __future__ import annotations

import numpy as np
from trident_fleet.core.mat_file import LAYOUTS_2D


def positions(steps: int, vehicles: int) -> np.ndarray:
    return np.arange(steps * vehicles * 3, dtype=np.float64).reshape(steps, vehicles, 3)


def laid_out(p: np.ndarray, layout: str) -> np.ndarray:
    if layout in LAYOUTS_2D:
        rows = p.reshape(-1, 3)
        return rows if layout == "TNx3" else rows.T
    return np.transpose(p, ["TN3".index(axis) for axis in layout.split("x")])
