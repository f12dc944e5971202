# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What followers should have done: the measured leader, and the places around it, as records."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from trident_base.flight_record import FOLLOW, FORMAT

from trident_fleet.core.encoding import NS_PER_S
from trident_fleet.core.follow.followers import Followers
from trident_fleet.core.follow.leader import LeaderState
from trident_fleet.core.quintic import Array

_ROW_S = 1.0
# Around the moment of joining, in which all are said to be at their places.
_JOINING_S = 0.5


@dataclass
class FollowLog:
    """The leader and the places of its followers at each period since all have joined.

    Attributes:
        leader: name of the leader.
        followers: names of the followers.
        start_ns: simulated time of the first set-point [ns].
        error: what went wrong; "" if nothing did.
    """

    leader: str
    followers: list[str]
    start_ns: int
    error: str = ""
    _time_s: list[float] = field(default_factory=list)
    _knots: list[Array] = field(default_factory=list)  # (3, N + 1, 3): p, v, a; leader first

    def add(self, followers: Followers, leader: LeaderState) -> None:
        """Take a state of the leader, stamped since the first set-point; once all have joined."""
        time_s = leader.stamp_ns / NS_PER_S
        if followers.joined_s is None or time_s < followers.joined_s:
            return
        if self._time_s and time_s <= self._time_s[-1]:
            return
        ideal = followers.ideal(leader)
        of_leader = (leader.position, leader.velocity, leader.acceleration)
        of_places = (ideal.position[0], ideal.velocity[0], ideal.acceleration[0])
        pairs = zip(of_leader, of_places, strict=True)
        self._time_s.append(time_s)
        self._knots.append(np.array([np.concatenate([own[None], all_]) for own, all_ in pairs]))

    def records(self, settings: dict[str, Any]) -> list[dict[str, Any]]:
        """A record of the leader and of each follower.

        Rows are places once a second; what is between the knots follows from their derivatives.
        """
        names = [self.leader, *self.followers]
        common = {
            "format": FORMAT,
            "mode": FOLLOW,
            "vehicles": names,
            "leader": self.leader,
            "start_time_s": self.start_ns / NS_PER_S,
            "source": {"file": ""},
            "settings": settings,
            "error": self.error,
        }
        if not self._time_s:
            missing = self.error or f"the followers have not joined {self.leader}"
            return [common | {"vehicle": name, "error": missing} for name in names]
        time, knots = np.array(self._time_s), np.stack(self._knots)
        rows = self._row_indices()
        return [
            common
            | {
                "vehicle": name,
                "rows": knots[rows, 0, index].tolist(),
                "row_time_s": time[rows].tolist(),
                "first_row_s": float(time[0]) - _JOINING_S,
                "hover_end_s": float(time[0]) + _JOINING_S,
                "end_time_s": (self.start_ns / NS_PER_S) + float(time[-1]),
                "knots": {
                    "time_s": time.tolist(),
                    "position": knots[:, 0, index].tolist(),
                    "velocity": knots[:, 1, index].tolist(),
                    "acceleration": knots[:, 2, index].tolist(),
                },
            }
            for index, name in enumerate(names)
        ]

    def _row_indices(self) -> list[int]:
        chosen = [0]
        for index, time in enumerate(self._time_s):
            if time - self._time_s[chosen[-1]] >= _ROW_S - 1e-6:
                chosen.append(index)
        return chosen
