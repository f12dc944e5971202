# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The set-points of a base station: up from its home, to places in its fence, and down again."""

from __future__ import annotations

import numpy as np

from trident_fleet.core.config import FlightLimits
from trident_fleet.core.errors import FormationError
from trident_fleet.core.quintic import Array, Motion, QuinticPath, hold
from trident_fleet.core.station.config import PilotConfig
from trident_fleet.core.station.fence import Fence
from trident_fleet.core.station.pilot import Other, Pilot, sampled
from trident_fleet.core.transit import transit_path

_CLIMB = FlightLimits(v_max=2.0, a_max=1.5, j_max=3.0)
_TURN_M = 0.3  # a turn of a route counts as reached this near
_HOME_M = 0.05
_ROUNDING_M = 1e-9


class Flyer:
    """Flies set-points to goals.

    Attributes:
        entry: where it enters the fence, above its home [m, world], shape (3,).
        has_landed: whether it stands at its home for good.
    """

    def __init__(self, fence: Fence, config: PilotConfig, home: Array, ground_s: float) -> None:
        """Stand at home, about to take off.

        Raises:
            FormationError: a home that is not below the fence, or a fence that is too narrow.
        """
        self._fence, self._margin_m = fence, config.margin_m
        self._home = np.array(home, dtype=np.float64)
        self.entry = self._entry_above(self._home)
        self.has_landed = False
        self._pilot = Pilot(fence, config, self.entry)
        climb = transit_path(np.stack([self._home, self.entry])[:, None], _CLIMB)
        self._path: QuinticPath | None = hold(self._home[None], ground_s).then(climb)
        self._path_s, self._ground_s = 0.0, ground_s  # since its begin
        self._is_landing = False
        self._route = [self.entry]

    def _entry_above(self, home: Array) -> Array:
        entry = np.array([home[0], home[1], self._fence.lowest_m + self._margin_m])
        if self._fence.clearance(entry[None])[0] < self._margin_m - _ROUNDING_M:
            raise FormationError(
                f"fence: the UAV starts at ({home[0]:g}, {home[1]:g}); legal: a polygon around"
                f" that, {self._margin_m:g} m away, and {2.0 * self._margin_m:g} m high"
            )
        if home[2] > entry[2]:
            raise FormationError(
                f"lowest: {self._fence.lowest_m:g} m; legal: above the start, {home[2]:g} m"
            )
        return entry

    @property
    def position(self) -> Array:
        """Of the set-point in the fence [m, world]; the entry while it takes off."""
        return self._pilot.position

    @property
    def is_waiting(self) -> bool:
        """Whether it stands before its take-off."""
        return self._path is not None and not self._is_landing and self._path_s < self._ground_s

    @property
    def is_flying(self) -> bool:
        """Whether it flies to its goals: not while it takes off or lands, nor afterwards."""
        return self._path is None and not self.has_landed

    def away_m(self, place: Array) -> float:
        """Of the set-point from a place [m]."""
        return float(np.linalg.norm(self._pilot.position - place))

    def may_be_at(self, place: Array) -> bool:
        """Whether a place keeps the margin."""
        return bool(self._fence.clearance(place[None])[0] >= self._margin_m - _ROUNDING_M)

    def fly_to(self, place: Array) -> None:
        """Go there, around the corners of the fence; as near as may be where no path leads."""
        route = self._fence.route(self._pilot.position, place, self._margin_m - _ROUNDING_M)
        self._route = [place] if route is None else list(route)

    def land_if_home(self) -> bool:
        """Begin to go down, if it is at the entry; whether it was."""
        if not self.is_flying or self.away_m(self.entry) > _HOME_M:
            return False
        down = np.stack([self._pilot.position, self._home])[:, None]
        self._path, self._path_s, self._is_landing = transit_path(down, _CLIMB), 0.0, True
        return True

    def period(self, time: Array, dt: float, others: list[Other]) -> Motion:
        """The set-points of the next period; periods follow each other.

        Args:
            time: of the points since the begin of the period [s], shape (M,).
            dt: length of the period [s].
            others: robots to keep away from.
        """
        if self._path is not None:
            return self._along_path(time, dt)
        if self.has_landed:
            return hold(self._home[None], 1.0).sample(time)
        while len(self._route) > 1 and self.away_m(self._route[0]) < _TURN_M:
            self._route.pop(0)
        position, velocity = self._pilot.position, self._pilot.velocity
        return sampled(position, velocity, self._pilot.step(self._route[0], dt, others), time)

    def _along_path(self, time: Array, dt: float) -> Motion:
        assert self._path is not None
        motion = self._path.sample(self._path.time[0] + self._path_s + time)
        self._path_s += dt
        if self._path_s >= self._path.duration:
            self._path, self.has_landed = None, self._is_landing
        return motion
