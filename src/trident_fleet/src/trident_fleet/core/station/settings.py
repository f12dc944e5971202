# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Settings of a base station's node from named parameters, checked by type and range."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from trident_base.params import Getter, Params, nearest, read, require

from trident_fleet.core.encoding import NS_PER_S
from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.formation_file import FormationSource
from trident_fleet.core.quintic import Array
from trident_fleet.core.settings import (
    FleetSettings,
    Vehicle,
    check_waits,
    fleet_of_names,
    names_of,
)
from trident_fleet.core.station.config import StationConfig
from trident_fleet.core.station.fence import Fence
from trident_fleet.core.station.geodesy import Datum

_LEFT = ("source", "plan", "gate", "mode", "lookahead")
#: Parameters that are no number of `StationConfig`, and their defaults.
TEXTS = {
    "vehicle": "uav1",
    "own_pose": "odometry_sensor1/odometry",
    "pose_topic": "odom",
    "link_status": "link_status",
    "battery": "battery",
}
STATUS_RATE_HZ = 2.0


@dataclass(frozen=True)
class StationSettings:
    """Everything a base station's node needs to know.

    Attributes:
        vehicle: the UAV.
        links: robots whose links are asked for.
        places: of robots that stand, p_world [m], shape (3,) each.
        pose_topics: of the other robots: where the UAV hears of them.
        own_pose: topic of the UAV's own pose.
        link_status: topic of its links.
        battery: topic of its battery.
        status_rate_hz: of the links' status, as the radio has it.
        datum: of the world, for geodetic poses; None: not known.
        fence: where the UAV may be.
        config: numbers.
        fleet: how set-points are fed.
    """

    vehicle: Vehicle
    links: list[str]
    places: dict[str, Array]
    pose_topics: dict[str, str]
    own_pose: str
    link_status: str
    battery: str
    status_rate_hz: float
    datum: Datum | None
    fence: Fence
    config: StationConfig
    fleet: FleetSettings

    @property
    def status_ns(self) -> int:
        """Time from one status to the next [ns]."""
        return round(NS_PER_S / self.status_rate_hz)


def read_station_settings(get: Getter) -> StationSettings:
    """Build settings from parameters.

    Args:
        get: value of a parameter, or None where it is not set.

    Raises:
        FormationError: a parameter of the wrong type or out of range, or one that is missing.
    """
    params = Params(get, FormationError)
    text = {name: params.text(name, default) for name, default in TEXTS.items()}
    (vehicle,) = fleet_of_names([text["vehicle"]])
    links = _links(params, vehicle.name)
    others = list(dict.fromkeys([*links, *names_of(params.given("avoid"))]))
    places = {name: _place(name, given) for name, given in _map(params, "places", others).items()}
    topics = _topics(params, others, places, vehicle, text["pose_topic"])
    fence = Fence(_corners(params), params.number("lowest", 15.0), params.number("highest", 30.0))
    fence.validate()
    config = read(StationConfig(), params, leave=("yaw_rad",))
    config = replace(config, yaw_rad=math.radians(params.number("yaw_deg", 0.0)))
    config.validate()
    fleet = read(FleetSettings(FormationSource()), params, leave=_LEFT)
    check_waits(fleet)
    fleet.feed.validate()
    rate_hz = _status_rate(params, fleet)
    own = vehicle.prefix
    return StationSettings(
        vehicle=vehicle,
        links=links,
        places=places,
        pose_topics=topics,
        own_pose=_below(own, text["own_pose"]),
        link_status=_below(own, text["link_status"]),
        battery=_below(own, text["battery"]),
        status_rate_hz=rate_hz,
        datum=_datum(params.given("datum")),
        fence=fence,
        config=config,
        fleet=fleet,
    )


def _below(prefix: str, topic: str) -> str:
    """A topic of the vehicle, unless it is a global one already."""
    return topic if topic.startswith("/") else prefix + topic


def _links(params: Params, own: str) -> list[str]:
    links = [name.strip("/") for name in names_of(params.given("links"))]
    if not links or len(set(links)) != len(links) or own in links or not all(links):
        raise FormationError(f"links: {links}; legal: one or more other robots, e.g. usv1, shore")
    return links


def _map(params: Params, name: str, others: list[str]) -> dict[str, Any]:
    """A map by robots."""
    given = params.given(name)
    if given is None:
        return {}
    if not isinstance(given, dict):
        raise FormationError(f"{name}: {given!r}; legal: a map, by names of robots")
    for key in given:
        if key not in others:
            raise FormationError(
                f"{name}: {key}; legal: {', '.join(others)}{nearest(str(key), others)}"
            )
    return given


def _place(name: str, given: Any) -> Array:
    return _numbers(f"places/{name}", given, (3,), "[x, y, z] [m, world]")


def _numbers(name: str, given: Any, shape: tuple[int, ...], legal: str) -> Array:
    try:
        found = np.array(given, dtype=np.float64)
    except (TypeError, ValueError):
        found = np.zeros(0)
    is_alike = found.ndim == len(shape) and all(
        wanted in (size, -1) for wanted, size in zip(shape, found.shape, strict=True)
    )
    if not is_alike or not np.isfinite(found).all():
        raise FormationError(f"{name}: {given!r}; legal: {legal}")
    return found


def _topics(
    params: Params, others: list[str], places: dict[str, Array], vehicle: Vehicle, topic: str
) -> dict[str, str]:
    given = _given_topics(params, others)
    return {
        name: _below(vehicle.prefix, given.get(name, f"from/{name}/{topic}"))
        for name in others
        if name in given or name not in places
    }


def _given_topics(params: Params, others: list[str]) -> dict[str, str]:
    given = _map(params, "poses", others)
    for name, value in given.items():
        if not isinstance(value, str) or not value:
            raise FormationError(f"poses/{name}: {value!r}; legal: the name of a topic")
    return given


def _corners(params: Params) -> Array:
    legal = "3 or more corners [x, y] [m, world]"
    return _numbers("fence", params.given("fence"), (-1, 2), legal)


def _datum(given: Any) -> Datum | None:
    if given is None:
        return None
    legal = "[latitude, longitude, height] [deg, deg, m]"
    latitude, longitude, height = _numbers("datum", given, (3,), legal)
    datum = Datum(float(latitude), float(longitude), float(height))
    datum.validate()
    return datum


def _status_rate(params: Params, fleet: FleetSettings) -> float:
    rate_hz = params.number("status_rate", STATUS_RATE_HZ)
    require("status_rate", rate_hz, 0.2, 20.0, "Hz", FormationError)
    if round(NS_PER_S / rate_hz) % fleet.feed.period_ns:
        period_s = fleet.feed.period_ns / NS_PER_S
        raise FormationError(
            f"status_rate: {rate_hz:g} Hz; legal: one whose period is a multiple of period,"
            f" {period_s:g} s"
        )
    return rate_hz
