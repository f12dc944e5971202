# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers of a formation flight: limits, waits, gates. One schema, validated at load."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from trident_base.params import named, require_positive

from trident_fleet.core.errors import FormationError


def check_positive(config: object, allow_zero: tuple[str, ...] = ()) -> None:
    """Raise FormationError if a number of a dataclass is not finite and over (or at) zero."""
    require_positive(config, allow_zero, FormationError)


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
        min_separation_m: wanted between any two vehicles while they fly to the first row [m]; less
            where the spawn positions or the first row themselves are closer.
        yaw_rad: heading of all vehicles [rad, world].
    """

    limits: FlightLimits = field(default_factory=FlightLimits)
    ground_s: float = named(0.5, "ground_time")
    hold_first_s: float = named(3.0, "hold_first")
    hold_last_s: float = named(3.0, "hold_last")
    climb_m: float = named(0.5, "climb")
    min_separation_m: float = named(1.0, "min_separation")
    yaw_rad: float = named(0.0, "yaw_deg", math.radians)

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

    radius_m: float = named(0.1, "gate_radius")
    timeout_s: float = named(10.0, "gate_timeout")
    settle_s: float = named(4.0, "gate_settle")
    average_s: float = named(1.0, "gate_average")
    max_offset_m: float = named(0.3, "gate_max_offset")
    hold_last_s: float = named(3.0, "hold_last")

    def validate(self) -> None:
        """Raise FormationError on the first field with an illegal value."""
        check_positive(self)
        if self.average_s > self.settle_s:
            raise FormationError(
                f"average_s: {self.average_s}; legal: at most settle_s {self.settle_s}"
            )
