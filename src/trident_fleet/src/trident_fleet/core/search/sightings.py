# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What robots say to each other of where they have looked.

A search is the sum of all looks, and a look is a place and a time: who knows the kind of robot
computes again what it saw. So each robot keeps a log that only grows, and members exchange what the
other has not heard, by the counts of what it has: it does not matter in which order and how often
parts come. A look takes 6 bytes instead of the hundreds of cells that it changes.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from trident_fleet.core.search.area import Lattice, SearchError

_HEAD = struct.Struct("<II")
_LOOK = np.dtype([("time", "<u2"), ("x", "<u2"), ("y", "<u2")])
_TIME_S, _STEPS = 0.05, 65535
_LARGEST_PART = 400


@dataclass(frozen=True)
class Look:
    """Where a robot looked for a short time.

    Attributes:
        time_s: in the middle of it [s].
        x: p_common [m].
        y: p_common [m].
    """

    time_s: float
    x: float
    y: float


@dataclass(frozen=True)
class LookPart:
    """Consecutive looks of one robot as they are sent.

    Attributes:
        robot: whose they are.
        first: number of the first one in the robot's log.
        data: the looks, packed.
    """

    robot: str
    first: int
    data: bytes


class Sightings:
    """The logs of all robots as far as one member has heard them."""

    def __init__(self, lattice: Lattice) -> None:
        """Empty.

        Args:
            lattice: of the area, within which all places lie.
        """
        self._lattice = lattice
        self._logs: dict[str, list[Look]] = {}

    def counts(self) -> dict[str, int]:
        """How many looks of each robot are known, without a gap."""
        return {robot: len(log) for robot, log in self._logs.items()}

    def add(self, robot: str, look: Look) -> Look:
        """Take down a robot's own look; returns it as others will know it."""
        log = self._logs.setdefault(robot, [])
        rounded = self._unpack(self._pack([look]))[0]
        log.append(rounded)
        return rounded

    def difference(self, known: dict[str, int]) -> list[LookPart]:
        """What somebody who knows so many looks of each robot has not heard."""
        parts = []
        for robot, log in self._logs.items():
            first = known.get(robot, 0)
            if first < len(log):
                looks = log[first : first + _LARGEST_PART]
                parts.append(LookPart(robot, first, self._pack(looks)))
        return parts

    def merge(self, part: LookPart, use: Callable[[str, Look], None]) -> int:
        """Take in what somebody has sent; what is known, or comes after a gap, is left out.

        Args:
            part: it.
            use: called with each look that is new.

        Returns:
            How many were new.

        Raises:
            SearchError: the part is damaged.
        """
        log = self._logs.setdefault(part.robot, [])
        if part.first > len(log):
            return 0
        new = self._unpack(part.data)[len(log) - part.first :]
        for look in new:
            log.append(look)
            use(part.robot, look)
        return len(new)

    def looks(self) -> Iterator[tuple[str, Look]]:
        """All that are known, robot by robot."""
        for robot, log in self._logs.items():
            for look in log:
                yield robot, look

    def _pack(self, looks: list[Look]) -> bytes:
        """Times as whole ticks since the first, so that relaying changes nothing."""
        length, width = self._lattice.size
        start = round(looks[0].time_s / _TIME_S)
        table = np.zeros(len(looks), dtype=_LOOK)
        for index, look in enumerate(looks):
            share_x = (look.x - self._lattice.origin[0]) / length
            share_y = (look.y - self._lattice.origin[1]) / width
            table[index] = (
                round(look.time_s / _TIME_S) - start,
                round(min(max(share_x, 0.0), 1.0) * _STEPS),
                round(min(max(share_y, 0.0), 1.0) * _STEPS),
            )
        return _HEAD.pack(start, len(looks)) + table.tobytes()

    def _unpack(self, data: bytes) -> list[Look]:
        count = _HEAD.unpack_from(data)[1] if len(data) >= _HEAD.size else -1
        if count < 0 or len(data) != _HEAD.size + count * _LOOK.itemsize:
            raise SearchError(f"looks: {len(data)} bytes, legal: 8 and 6 for each look")
        start = _HEAD.unpack_from(data)[0]
        length, width = self._lattice.size
        table = np.frombuffer(data, dtype=_LOOK, offset=_HEAD.size)
        return [
            Look(
                (start + time) * _TIME_S,
                self._lattice.origin[0] + float(x) / _STEPS * length,
                self._lattice.origin[1] + float(y) / _STEPS * width,
            )
            for time, x, y in table.tolist()
        ]
