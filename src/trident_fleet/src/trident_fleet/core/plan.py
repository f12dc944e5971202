# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A whole formation flight: wait, take off, go to the first row, hover, fly the rows, hover."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from trident_fleet.core.config import PlanConfig
from trident_fleet.core.errors import FormationError, RowError
from trident_fleet.core.quintic import Array, Motion, QuinticPath, hold
from trident_fleet.core.timing import fly_through
from trident_fleet.core.transit import transit_path, transit_points

FARTHEST_M = 10_000.0


@dataclass(frozen=True)
class FormationPlan:
    """Motion of all vehicles from take-off to the hover at the last row; a pure function of inputs.

    Attributes:
        path: the motion; time 0 is the first set-point.
        rows: p_world of each row and vehicle [m], shape (T, N, 3).
        row_time: when row i is passed [s], shape (T,); hovering at row 0 ends at `row_time[0]`.
        first_row_s: when row 0 is reached, before the hover [s].
        yaw_rad: heading of all vehicles [rad, world].
    """

    path: QuinticPath
    rows: Array
    row_time: Array
    first_row_s: float
    yaw_rad: float

    @property
    def duration(self) -> float:
        """From the first set-point to the end of the hover at the last row [s]."""
        return self.path.duration

    def sample(self, time: Array) -> Motion:
        """Commanded motion at times [s] since the first set-point, shape (M,)."""
        return self.path.sample(time)


def plan_formation(rows: Array, spawn: Array, config: PlanConfig) -> FormationPlan:
    """Plan a formation flight.

    Args:
        rows: p_world of each row and vehicle [m], shape (T, N, 3).
        spawn: where the vehicles stand [m, world], shape (N, 3).
        config: limits and waits.

    Returns:
        The plan; the same inputs give the same plan to the bit.

    Raises:
        FormationError: a row too far away or below the ground, or no free path to the first row.
    """
    config.validate()
    lead = plan_take_off(rows, spawn, config)
    first_row_s = lead.duration
    path = lead.then(hold(rows[0], config.hold_first_s))
    begin = path.duration
    row_time = np.array([begin])
    if len(rows) > 1:
        flight = fly_through(rows, config.limits)
        row_time = begin + flight.time
        path = path.then(flight)
    path = path.then(hold(rows[-1], config.hold_last_s))
    return FormationPlan(path, rows, row_time, first_row_s, config.yaw_rad)


def plan_take_off(rows: Array, spawn: Array, config: PlanConfig) -> QuinticPath:
    """The part up to rest at the first row. Arguments and errors as for `plan_formation`."""
    _check_rows(rows, spawn)
    points = transit_points(spawn, rows[0], config)
    return hold(spawn, config.ground_s).then(transit_path(points, config.limits))


def _check_rows(rows: Array, spawn: Array) -> None:
    if not np.isfinite(spawn).all():
        raise FormationError(f"spawn positions: {spawn.tolist()}; legal: finite numbers")
    check_reach(rows)
    check_height(rows, float(spawn[:, 2].min()))


def check_reach(rows: Array) -> None:
    """Refuse rows, shape (T, N, 3) [m, world], that lie too far away.

    Raises:
        RowError: such a row; names it, the vehicle and the place.
    """
    is_near = (np.abs(rows) <= FARTHEST_M).all(axis=-1)
    _refuse(rows, ~is_near, f"|x|, |y|, |z| <= {FARTHEST_M:g} m")


def check_height(rows: Array, lowest_m: float) -> None:
    """Refuse rows, shape (T, N, 3) [m, world], below the place of the lowest vehicle.

    Raises:
        RowError: such a row; names it, the vehicle and the place.
    """
    _refuse(rows, rows[..., 2] < lowest_m, f"z >= spawn height {lowest_m:g} m")


def _refuse(rows: Array, bad: npt.NDArray[np.bool_], legal: str) -> None:
    if bad.any():
        row, vehicle = np.argwhere(bad)[0]
        x, y, z = rows[row, vehicle]
        raise RowError(
            f"row {row + 1}, vehicle {vehicle + 1}: ({x:g}, {y:g}, {z:g}) m after scale and"
            f" offset; legal: {legal}"
        )
