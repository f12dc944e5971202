# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Settings of a formation node from named parameters, checked by type and range."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from trident_fleet.core.config import FlightLimits, GateConfig, PlanConfig
from trident_fleet.core.errors import FormationError
from trident_fleet.core.formation_file import FormationSource, Vector
from trident_fleet.core.schedule import FeedConfig

MODES = ("time", "gate")
Getter = Callable[[str], Any]


@dataclass(frozen=True)
class Vehicle:
    """One vehicle of the formation.

    Attributes:
        name: model name in the simulator, e.g. `UAV1`.
        prefix: of its topics, e.g. `/UAV1/`.
        index: its column in the formation, from 0.
    """

    name: str
    prefix: str
    index: int


@dataclass(frozen=True)
class FleetSettings:
    """Everything a formation node needs to know; the same in all processes but for `fed`.

    Attributes:
        source: which file and how to read it.
        plan: take-off, limits and waits.
        gate: arrival gate of the row-by-row mode.
        feed: period and spacing of set-points.
        mode: `time` (planned in time, with feed-forward) or `gate` (row by row).
        lookahead: how many periods ahead of /clock set-points are sent in `time` mode.
        guard: send again what another publisher on the same topic has overridden.
        enroll_wait_s: how long a simulator may take to offer lockstep, wall-clock time [s].
        connect_wait_s: how long a vehicle's controller may take to listen, wall-clock time [s].
    """

    source: FormationSource
    plan: PlanConfig = field(default_factory=PlanConfig)
    gate: GateConfig = field(default_factory=GateConfig)
    feed: FeedConfig = field(default_factory=FeedConfig)
    mode: str = "time"
    lookahead: int = 10
    guard: bool = False
    enroll_wait_s: float = 5.0
    connect_wait_s: float = 20.0


def read_settings(get: Getter, default_file: str) -> FleetSettings:
    """Build settings from parameters.

    Args:
        get: value of a parameter, or None where it is not set.
        default_file: formation file if the parameter `formation_file` is not set or empty.

    Raises:
        FormationError: a parameter of the wrong type or out of range.
    """
    params = Params(get)
    mode = params.text("mode", "time")
    if mode not in MODES:
        raise FormationError(f"mode: '{mode}'; legal: {', '.join(MODES)}")
    settings = FleetSettings(
        source=_source(params, default_file),
        plan=_plan(params),
        gate=_gate(params),
        feed=read_feed(params),
        mode=mode,
        lookahead=params.integer("lookahead", 5),
        guard=params.flag("guard", False),
        enroll_wait_s=params.number("enroll_wait", 5.0),
        connect_wait_s=params.number("connect_wait", 20.0),
    )
    for part in (settings.source, settings.plan, settings.gate, settings.feed):
        part.validate()
    if not 0 <= settings.lookahead <= 100:
        raise FormationError(f"lookahead: {settings.lookahead}; legal: 0 to 100 periods")
    return settings


def fleet_around(prefix: str, index: int, count: int) -> list[Vehicle]:
    """All vehicles of a formation, from what one of them knows about itself.

    Vehicle names count up: if index 1 is `/UAV2/`, index 0 is `/UAV1/`.

    Args:
        prefix: topic prefix of this vehicle, e.g. `/UAV1/`.
        index: its index, from 0.
        count: number of vehicles.

    Raises:
        FormationError: a prefix without a number in a formation of several, or one too small.
    """
    own = "/" + prefix.strip("/") + "/" if prefix.strip("/") else ""
    match = re.fullmatch(r"(.*?)(\d+)/", own)
    if count == 1 and own:
        return [_vehicle(own, 0)]
    if not match or int(match[2]) < index:
        raise FormationError(
            f"UAV: '{prefix}' for vehicle {index + 1} of {count}; legal: a name that ends in a"
            f" number, {index} or more, e.g. /UAV{index + 1}/"
        )
    first = int(match[2]) - index
    return [_vehicle(f"{match[1]}{first + i}/", i) for i in range(count)]


def seat_of_sequence(seq: int, vehicles_in_file: int, uavs: int) -> tuple[int, int]:
    """What a vehicle's first line in the file says: its index and the row it begins with.

    Lines are interleaved vehicle by vehicle, so a vehicle that starts at line `seq` (from 0)
    advances by the number of vehicles.

    Args:
        seq: line that the vehicle starts at.
        vehicles_in_file: how many vehicles are interleaved.
        uavs: how many of them fly.

    Raises:
        FormationError: negative, or a vehicle that does not fly.
    """
    if seq < 0:
        raise FormationError(f"seq: {seq}; legal: 0 or more")
    row, index = divmod(seq, vehicles_in_file)
    if index >= uavs:
        raise FormationError(
            f"seq: {seq} is vehicle {index + 1} of {vehicles_in_file}, but uavs is {uavs}; legal:"
            f" 0 to {uavs - 1}"
        )
    return index, row


def names_of(given: Any) -> list[str]:
    """Names from a list, or from a text with commas or blanks between them."""
    if isinstance(given, str):
        return given.replace(",", " ").split()
    return [str(name) for name in given or []]


def fleet_of_names(names: list[str]) -> list[Vehicle]:
    """Vehicles in the order of their names, each in the namespace of its name.

    Raises:
        FormationError: an empty list, an empty name or the same name twice.
    """
    if not names or not all(name.strip("/") for name in names) or len(set(names)) != len(names):
        raise FormationError(f"vehicles: {names}; legal: different names, e.g. UAV1, UAV2")
    return [_vehicle("/" + name.strip("/") + "/", index) for index, name in enumerate(names)]


def _vehicle(prefix: str, index: int) -> Vehicle:
    return Vehicle(name=prefix.strip("/").rsplit("/", 1)[-1], prefix=prefix, index=index)


def read_feed(params: Params) -> FeedConfig:
    """Period and spacing of set-points."""
    return FeedConfig(
        period_ns=round(params.number("period", 0.1) * 1e9),
        point_ns=round(params.number("point_spacing", 0.01) * 1e9),
    )


def _source(params: Params, default_file: str) -> FormationSource:
    return FormationSource(
        file=params.text("formation_file", "") or default_file,
        vehicles_in_file=params.integer("vehicles_in_file", 0),
        uavs=params.integer("uavs", 0),
        scale=params.vector("scale", 1.0),
        offset=params.vector("offset", 0.0),
        layout=params.text("layout", ""),
    )


def _plan(params: Params) -> PlanConfig:
    limits, plan = FlightLimits(), PlanConfig()
    return PlanConfig(
        limits=FlightLimits(
            v_max=params.number("v_max", limits.v_max),
            a_max=params.number("a_max", limits.a_max),
            j_max=params.number("j_max", limits.j_max),
        ),
        ground_s=params.number("ground_time", plan.ground_s),
        hold_first_s=params.number("hold_first", plan.hold_first_s),
        hold_last_s=params.number("hold_last", plan.hold_last_s),
        climb_m=params.number("climb", plan.climb_m),
        min_separation_m=params.number("min_separation", plan.min_separation_m),
        yaw_rad=math.radians(params.number("yaw_deg", 0.0)),
    )


def _gate(params: Params) -> GateConfig:
    gate = GateConfig()
    return GateConfig(
        radius_m=params.number("gate_radius", gate.radius_m),
        timeout_s=params.number("gate_timeout", gate.timeout_s),
        settle_s=params.number("gate_settle", gate.settle_s),
        hold_last_s=params.number("hold_last", gate.hold_last_s),
    )


class Params:
    """Typed access, with one clear error for a value of another type."""

    def __init__(self, get: Getter) -> None:
        """Read from `get`, which gives None for a parameter that is not set."""
        self._get = get

    def text(self, name: str, default: str) -> str:
        """A text."""
        value = self._get(name)
        if value is None:
            return default
        if not isinstance(value, str):
            raise FormationError(f"{name}: {value!r}; legal: a text")
        return value

    def number(self, name: str, default: float) -> float:
        """A finite number."""
        value = self._get(name)
        if value is None:
            return default
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise FormationError(f"{name}: {value!r}; legal: a number")
        if not math.isfinite(value):
            raise FormationError(f"{name}: {value}; legal: a finite number")
        return float(value)

    def integer(self, name: str, default: int) -> int:
        """A whole number."""
        value = self._get(name)
        if value is None:
            return default
        if isinstance(value, bool) or not isinstance(value, int):
            raise FormationError(f"{name}: {value!r}; legal: a whole number")
        return value

    def flag(self, name: str, default: bool) -> bool:
        """True or false."""
        value = self._get(name)
        if value is None:
            return default
        if not isinstance(value, bool):
            raise FormationError(f"{name}: {value!r}; legal: true or false")
        return value

    def vector(self, name: str, default: float) -> Vector:
        """Components `name_x`, `name_y`, `name_z`, each by default `name`, by default `default`."""
        common = self.number(name, default)
        x, y, z = (self.number(f"{name}_{axis}", common) for axis in "xyz")
        return x, y, z
