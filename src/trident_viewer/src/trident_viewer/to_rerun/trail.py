# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Where something has been, in a bounded number of points."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

_FIRST_STEP_M = 0.05
_MAX_PLACES = 512


class Trail:
    """Places at least a step apart; when there are too many, every other one goes."""

    def __init__(self) -> None:
        """Nothing has been anywhere."""
        self._places: list[tuple[float, float, float]] = []
        self._step_m = _FIRST_STEP_M

    def add(self, x: float, y: float, z: float) -> bool:
        """Takes a place [m]; whether it is one step or more from the last one."""
        place = (x, y, z)
        if self._places and float(np.linalg.norm(np.subtract(place, self._places[-1]))) < (
            self._step_m
        ):
            return False
        self._places.append(place)
        if len(self._places) > _MAX_PLACES:
            self._places = self._places[::2]
            self._step_m *= 2.0
        return True

    @property
    def places(self) -> npt.NDArray[np.float64]:
        """All of them [m], shape (N, 3)."""
        return np.array(self._places, np.float64).reshape(-1, 3)
