# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Which set-point message is due when: period n covers [start + n T, start + (n+1) T)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from trident_base.params import named

from trident_fleet.core.encoding import NS_PER_S, encode_message, encode_points, sample_times
from trident_fleet.core.errors import FormationError
from trident_fleet.core.plan import FormationPlan
from trident_fleet.core.quintic import Array, Motion


def nanoseconds(seconds: float) -> int:
    """A time in whole nanoseconds."""
    return round(seconds * 1e9)


@dataclass(frozen=True)
class FeedConfig:
    """How set-points are fed to the controllers.

    Attributes:
        period_ns: time that one message covers [ns].
        point_ns: spacing of the points within a message [ns].
    """

    period_ns: int = named(100_000_000, "period", nanoseconds)
    point_ns: int = named(10_000_000, "point_spacing", nanoseconds)

    def validate(self) -> None:
        """Raise FormationError on the first field with an illegal value."""
        if not 50_000_000 <= self.period_ns <= 1_000_000_000:
            raise FormationError(f"period: {self.period_ns / 1e9:g} s; legal: 0.05 to 1 s")
        if self.point_ns <= 0 or self.period_ns % self.point_ns:
            raise FormationError(
                f"point_spacing: {self.point_ns / 1e9:g} s; legal: a whole part of period"
                f" {self.period_ns / 1e9:g} s"
            )


class PlannedFeed:
    """The messages of a plan, for one vehicle or several, in order of time."""

    def __init__(
        self, plan: FormationPlan, vehicles: list[int], start_ns: int, config: FeedConfig
    ) -> None:
        """Encode all of the plan.

        Args:
            plan: what to fly.
            vehicles: indices of the vehicles to feed.
            start_ns: stamp of message 0 [ns].
            config: period and spacing.
        """
        self._config = config
        self._start_ns = start_ns
        per_message = config.period_ns // config.point_ns
        self._count = int(np.ceil(plan.duration * NS_PER_S / config.period_ns)) + 1
        offsets = np.arange(self._count * per_message, dtype=np.int64) * config.point_ns
        motion = plan.sample(offsets / NS_PER_S)
        self._blocks = [
            encode_points(motion, vehicle, plan.yaw_rad, offsets % config.period_ns).reshape(
                self._count, per_message
            )
            for vehicle in vehicles
        ]

    def stamp_ns(self, index: int) -> int:
        """Stamp of message `index` [ns]."""
        return self._start_ns + index * self._config.period_ns

    def index_at(self, time_ns: int) -> int:
        """The message that covers `time_ns`; negative before the first one."""
        return (time_ns - self._start_ns) // self._config.period_ns

    def messages(self, index: int) -> list[bytes]:
        """Message `index` >= 0 of each vehicle; after the plan's end the last hover continues."""
        stamp = self.stamp_ns(index)
        last = min(index, self._count - 1)
        return [encode_message(stamp, block[last]) for block in self._blocks]


def encode_period(
    motion: Motion, vehicles: list[int], yaw_rad: float, stamp_ns: int, config: FeedConfig
) -> list[bytes]:
    """One message per vehicle from the samples of one period."""
    offsets = np.arange(0, config.period_ns, config.point_ns, dtype=np.int64)
    return [
        encode_message(stamp_ns, encode_points(motion, vehicle, yaw_rad, offsets))
        for vehicle in vehicles
    ]


def period_times(elapsed_ns: int, config: FeedConfig) -> Array:
    """Times of the points of the period that begins `elapsed_ns` after the first one [s]."""
    return sample_times(elapsed_ns, config.period_ns, config.point_ns)
