# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Settings of a leader-follower node from named parameters, checked by type and range."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from trident_base.params import Getter, Params, read

from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.formation_file import FormationSource
from trident_fleet.core.follow.follow_config import FollowConfig
from trident_fleet.core.patterns import Pattern, places
from trident_fleet.core.quintic import Array
from trident_fleet.core.settings import (
    FleetSettings,
    Vehicle,
    check_waits,
    fleet_of_names,
    names_of,
)

#: Before the names of the limits (`v_max` ...) of the flight to the places.
TRANSIT = "transit_"
LEADER_TIMEOUT_S = 2.0
#: What a leader-follower flight has no use for, or makes itself of other parameters.
_LEFT = ("offsets", "plan.hold_first_s", "plan.hold_last_s", "plan.min_separation_m")


@dataclass(frozen=True)
class FollowSettings:
    """Everything a leader-follower node needs to know.

    Attributes:
        leader: model name of the leader in the simulator, or any name for one outside.
        leader_topic: its odometry or pose; "": the simulator's fleet state.
        followers: the vehicles that are commanded.
        config: places, limits and waits.
        fleet: how set-points are fed.
        leader_timeout_s: silence after which the leader counts as lost [s].
    """

    leader: str
    leader_topic: str
    followers: list[Vehicle]
    config: FollowConfig
    fleet: FleetSettings
    leader_timeout_s: float


def read_follow_settings(get: Getter) -> FollowSettings:
    """Build settings from parameters.

    Args:
        get: value of a parameter, or None where it is not set.

    Raises:
        FormationError: a parameter of the wrong type or out of range.
    """
    params = Params(get, FormationError)
    followers = fleet_of_names(names_of(params.given("followers")))
    leader = params.text("leader", "UAV1").strip("/")
    if leader in [vehicle.name for vehicle in followers]:
        raise FormationError(f"followers: {leader} is the leader; legal: other vehicles")
    offsets = read_offsets(params.given("offsets"), params, len(followers))
    config = read(FollowConfig(offsets), params, {"plan.limits": TRANSIT}, leave=_LEFT)
    config.validate()
    timeout_s = params.number("leader_timeout", LEADER_TIMEOUT_S)
    if timeout_s <= 0.0:
        raise FormationError(f"leader_timeout: {timeout_s}; legal: greater than 0")
    fleet = FleetSettings(FormationSource(), plan=config.plan, feed=config.feed)
    fleet = read(fleet, params, leave=("source", "plan", "gate", "feed", "mode"))
    check_waits(fleet)
    topic = params.text("leader_topic", "")
    return FollowSettings(leader, topic, followers, config, fleet, timeout_s)


def read_offsets(given: Any, params: Params, count: int) -> Array:
    """Places around the leader, shape (count, 3) [m]: as given, or by `pattern` and `spacing`.

    The leader has the foremost place of a pattern, of several the most central one; in a circle, it
    is in the middle.

    Raises:
        FormationError: not as many places as followers, or an unknown pattern.
    """
    if given is not None:
        return _given_offsets(given, count)
    pattern = Pattern(
        kind=params.text("pattern", "wedge"),
        spacing_m=params.number("spacing", 2.0),
        opening_deg=params.number("opening_deg", Pattern("wedge").opening_deg),
    )
    if pattern.kind == "circle":
        # Up to six on a circle are nearer to its middle than to each other.
        return places(replace(pattern, radius_m=pattern.spacing_m if count <= 6 else 0.0), count)
    points = places(pattern, count + 1)
    order = np.lexsort((np.abs(points[:, 1]), -np.round(points[:, 0], 6)))
    return np.delete(points, order[0], axis=0) - points[order[0]]


def _given_offsets(given: Any, count: int) -> Array:
    try:
        offsets = np.array(given, dtype=np.float64)
    except (TypeError, ValueError):
        offsets = np.zeros(0)
    if offsets.shape != (count, 3):
        raise FormationError(
            f"offsets: {given!r}; legal: [x, y, z] in metres for each of {count} followers"
        )
    return offsets
