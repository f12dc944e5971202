# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Kinds of robots, and what a mission is, from one YAML file."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

from trident_fleet.core.files.strict_yaml import Section, load
from trident_fleet.core.network import LinkModel
from trident_fleet.core.search.area import SearchError
from trident_fleet.core.search.belief import Prior
from trident_fleet.core.search.detection import Sensor
from trident_fleet.core.search.drift import Sea, leeway_named
from trident_fleet.core.tasks.fields import DOMAINS, Capabilities

_UNLIMITED = math.inf


@dataclass(frozen=True)
class Kind:
    """One kind of robot.

    Attributes:
        name: of it, e.g. uav.
        domain: it moves in.
        speed_m_s: of travel [m/s].
        sensor: that it searches with.
        lane_land_m: distance between parallel passes that cover land [m].
        lane_water_m: the same on the water [m].
        endurance_s: of a battery [s]; infinite: enough.
        recharge_s: for a new one, at the base [s].
        serves: it can serve people where it gets to.
    """

    name: str
    domain: str
    speed_m_s: float
    sensor: Sensor
    lane_land_m: float
    lane_water_m: float
    endurance_s: float = _UNLIMITED
    recharge_s: float = 0.0
    serves: bool = False

    def capabilities(self) -> Capabilities:
        """As the contract net has them."""
        skills = ("search", "serve") if self.serves else ("search",)
        return Capabilities(self.domain, skills, speed_m_s=self.speed_m_s)


@dataclass(frozen=True)
class Links:
    """The network where there are no radios.

    Attributes:
        model: of every link.
        range_m: of a link [m].
        relay_range_m: within which a robot in the air carries messages between others [m].
    """

    model: LinkModel
    range_m: float
    relay_range_m: float


@dataclass(frozen=True)
class Rules:
    """When a person is confirmed and served, and when a mission ends.

    Attributes:
        confirm_m: a robot that sees the person stands within this [m]...
        confirm_s: ... for this long [s].
        serve_m: one that serves stands within this [m]...
        serve_s: ... for this long [s].
        until_s: the mission ends at the latest [s].
        enough: share of the cells that is covered when it ends before, with all people served.
        sectors: along x and y.
        sector_share: of the cells of a sector that is covered where it counts.
    """

    confirm_m: float = 10.0
    confirm_s: float = 5.0
    serve_m: float = 3.0
    serve_s: float = 20.0
    until_s: float = 900.0
    enough: float = 0.97
    sectors: tuple[int, int] = (8, 5)
    sector_share: float = 0.95


@dataclass(frozen=True)
class MissionConfig:
    """All numbers of a mission.

    Attributes:
        kinds: of robots by name.
        rules: of the mission.
        links: of the team.
        sea: what moves people in the water.
        wave_height_m: significant height of the waves [m].
        prior: of where people are.
    """

    kinds: dict[str, Kind]
    rules: Rules
    links: Links
    sea: Sea
    wave_height_m: float
    prior: Prior


def read_mission(path: Path) -> MissionConfig:
    """A mission's numbers.

    Raises:
        FormationError: what is wrong, with file, line, key, value and legal range.
    """
    file = load(path)
    part = file.section("robots")
    kinds = {name: _kind(part.section(name), name) for name in part.names()}
    if not kinds:
        raise file.error("robots", "none; legal: kinds of robots by name")
    config = MissionConfig(
        kinds,
        _rules(file.section("rules")),
        _links(file.section("links")),
        *_sea(file.section("sea")),
        _prior(file.section("prior")),
    )
    file.finish()
    return config


def _positive(part: Section, name: str, default: float) -> float:
    value = part.number(name, default)
    if not value > 0.0:
        raise part.error(name, f"{value:g}; legal: above 0")
    return value


def _flag(part: Section, name: str) -> bool:
    value = part.value(name) if name in part else False
    if not isinstance(value, bool):
        raise part.error(name, f"{value!r}; legal: true or false")
    if name not in part:
        part.skip(name)
    return value


def _kind(part: Section, name: str) -> Kind:
    domain = part.choice("domain", DOMAINS)
    try:
        sensor = Sensor(
            part.number("range", 15.0),
            part.number("height", 1.5),
            part.number("detect", 0.4),
            part.number("cover_land", 0.6),
            part.number("cover_water", 0.6),
            domain == "air",
        )
    except SearchError as error:
        raise part.error_here(str(error)) from None
    endurance_s = part.number("endurance", 0.0)
    kind = Kind(
        name,
        domain,
        _positive(part, "speed", 1.0),
        sensor,
        _positive(part, "lane_land", 20.0),
        _positive(part, "lane_water", 20.0),
        endurance_s if endurance_s > 0.0 else _UNLIMITED,
        part.number("recharge", 0.0),
        _flag(part, "serves"),
    )
    part.finish()
    return kind


def _rules(part: Section) -> Rules:
    default = Rules()
    rules = Rules(
        confirm_m=_positive(part, "confirm_within", default.confirm_m),
        confirm_s=_positive(part, "confirm_time", default.confirm_s),
        serve_m=_positive(part, "serve_within", default.serve_m),
        serve_s=_positive(part, "serve_time", default.serve_s),
        until_s=_positive(part, "until", default.until_s),
        enough=_positive(part, "enough", default.enough),
    )
    part.finish()
    return rules


def _links(part: Section) -> Links:
    try:
        model = LinkModel(
            loss=part.number("loss", 0.0),
            double=part.number("double", 0.0),
            min_delay_s=part.number("min_delay", 0.0),
            max_delay_s=part.number("max_delay", 0.0),
        )
    except ValueError as error:
        raise part.error_here(str(error)) from None
    links = Links(model, _positive(part, "range", 150.0), _positive(part, "relay_range", 400.0))
    part.finish()
    return links


def _sea(part: Section) -> tuple[Sea, float]:
    current_m_s, current_rad = part.number("current", 0.0), part.number("current_direction", 0.0)
    wind_m_s, wind_rad = part.number("wind", 0.0), part.number("wind_direction", 0.0)
    leeway = part.text("leeway", "person_sitting")
    wave_height_m = part.number("wave_height", 0.0)
    try:
        sea = Sea(
            (current_m_s * math.cos(current_rad), current_m_s * math.sin(current_rad)),
            (wind_m_s * math.cos(wind_rad), wind_m_s * math.sin(wind_rad)),
            leeway_named(leeway),
        )
    except SearchError as error:
        raise part.error_here(str(error)) from None
    part.finish()
    return sea, wave_height_m


def _prior(part: Section) -> Prior:
    try:
        prior = Prior(
            part.number("open_land", 5.0), part.number("covered", 2.0), part.number("water", 5.0)
        )
    except SearchError as error:
        raise part.error_here(str(error)) from None
    part.finish()
    return prior
