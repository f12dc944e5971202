# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Settings of a formation node from named parameters, checked by type and range."""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace
from typing import Any

from trident_base.params import Getter, Params, named, read

from trident_fleet.core.config import GateConfig, PlanConfig
from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.formation_file import FormationSource
from trident_fleet.core.schedule import FeedConfig

MODES = ("time", "gate")


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
    lookahead: int = 5
    guard: bool = False
    enroll_wait_s: float = named(5.0, "enroll_wait")
    connect_wait_s: float = named(20.0, "connect_wait")


def read_settings(get: Getter, default_file: str) -> FleetSettings:
    """Build settings from parameters.

    Args:
        get: value of a parameter, or None where it is not set.
        default_file: formation file if the parameter `formation_file` is not set or empty.

    Raises:
        FormationError: a parameter of the wrong type or out of range.
    """
    settings = read(FleetSettings(FormationSource(default_file)), Params(get, FormationError))
    if not settings.source.file:
        settings = replace(settings, source=replace(settings.source, file=default_file))
    if settings.mode not in MODES:
        raise FormationError(f"mode: '{settings.mode}'; legal: {', '.join(MODES)}")
    for part in (settings.source, settings.plan, settings.gate, settings.feed):
        part.validate()
    check_waits(settings)
    return settings


def check_waits(settings: FleetSettings) -> None:
    """Raise FormationError if the horizon or a limit of waiting is not legal."""
    if not 0 <= settings.lookahead <= 100:
        raise FormationError(f"lookahead: {settings.lookahead}; legal: 0 to 100 periods")
    for name in ("enroll_wait_s", "connect_wait_s"):
        value = getattr(settings, name)
        if value <= 0.0:
            raise FormationError(f"{name.removesuffix('_s')}: {value}; legal: greater than 0")


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


def vehicle_of_line(seq: int, vehicles_in_file: int, uavs: int) -> tuple[int, int]:
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
    return [str(name) for name in (given if isinstance(given, list) else [given] if given else [])]


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
