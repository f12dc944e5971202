# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers of a formation flight: limits, waits, gates. One schema, validated at load."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields

from trident_fleet.core.errors import FormationError


def check_positive(config: object, allow_zero: tuple[str, ...] = ()) -> None:
    """Raise FormationError if a number of a dataclass is not finite and over (or at) zero."""
    for item in fields(config):  # type: ignore[arg-type]
        value = getattr(config, item.name)
        if not isinstance(value, int | float) or isinstance(value, bool):
            continue
        legal = value >= 0 if item.name in allow_zero else value > 0
        if not math.isfinite(value) or not legal:
            bound = "0 or more" if item.name in allow_zero else "greater than 0"
            raise FormationError(f"{item.name}: {value}; legal: finite, {bound}")


@dataclass(frozen=True)
class FlightLimits:
    """What any vehicle of the formation may be asked to do.

    Attributes:
        v_max: speed [m/s].
        a_max: acceleration [m/s^2].
        j_max: jerk [m/s^3]: how fast the attitude has to follow.
    """

    v_max: float = 1.6
    a_max: float = 1.0
    j_max: float = 2.0

    def validate(self) -> None:
        """Raise FormationError on the first field with an illegal value."""
        check_positive(self)


@dataclass(frozen=True)
class PlanConfig:
    """How a formation flight is put together.

    Attributes:
        limits: of every vehicle at every instant.
        ground_s: wait at the spawn positions before take-off [s].
        hold_first_s: hover at the first row [s].
        hold_last_s: hover at the last row [s].
        climb_m: height of the vertical climb above the highest spawn position [m].
        min_separation_m: wanted between any two vehicles on the way to the first row [m]; less
            where the spawn positions or the first row themselves are closer.
        yaw_rad: heading of all vehicles [rad, world].
    """

    limits: FlightLimits = field(default_factory=FlightLimits)
    ground_s: float = 0.5
    hold_first_s: float = 3.0
    hold_last_s: float = 3.0
    climb_m: float = 0.5
    min_separation_m: float = 1.0
    yaw_rad: float = 0.0

    def validate(self) -> None:
        """Raise FormationError on the first field with an illegal value."""
        self.limits.validate()
        if not math.isfinite(self.yaw_rad):
            raise FormationError(f"yaw_rad: {self.yaw_rad}; legal: finite")
        shown = PlanConfig(**{**self.__dict__, "yaw_rad": 0.0})
        check_positive(shown, allow_zero=("yaw_rad", "min_separation_m"))


@dataclass(frozen=True)
class GateConfig:
    """The arrival gate of the row-by-row mode.

    Attributes:
        radius_m: a vehicle has arrived when its position error, less its steady offset, is
            smaller than this [m].
        timeout_s: longest wait for one row [s].
        settle_s: hover at the first row before the steady offset is taken [s].
        average_s: the last part of that hover, over which the offset is averaged [s].
        max_offset_m: a vehicle that hovers farther than this from the first row has not arrived
            there at all [m].
        hold_last_s: hover at the last row [s].
    """

    radius_m: float = 0.1
    timeout_s: float = 10.0
    settle_s: float = 4.0
    average_s: float = 1.0
    max_offset_m: float = 0.3
    hold_last_s: float = 3.0

    def validate(self) -> None:
        """Raise FormationError on the first field with an illegal value."""
        check_positive(self)
        if self.average_s > self.settle_s:
            raise FormationError(
                f"average_s: {self.average_s}; legal: at most settle_s {self.settle_s}"
            )
