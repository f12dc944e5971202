# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from trident_fleet.core.errors import FormationError
from trident_fleet.core.follow.follow_settings import read_follow_settings

GOOD: dict[str, Any] = {"followers": "UAV2, UAV3 UAV4"}
S = math.sqrt(0.5)


def test_little_has_to_be_given() -> None:
    settings = read_follow_settings(GOOD.get)
    assert settings.leader == "UAV1"
    assert settings.leader_topic == ""
    assert [vehicle.prefix for vehicle in settings.followers] == ["/UAV2/", "/UAV3/", "/UAV4/"]
    assert settings.config.frame == "heading"
    assert settings.fleet.feed.period_ns == 100_000_000


@pytest.mark.parametrize(
    ("pattern", "expected"),
    [
        ("wedge", [[-2 * S, 2 * S, 0], [-2 * S, -2 * S, 0], [-4 * S, 4 * S, 0]]),
        ("line", [[0, 2, 0], [0, -2, 0], [0, -4, 0]]),
        ("grid", [[0, -2, 0], [-2, 0, 0], [-2, -2, 0]]),
        ("circle", [[2, 0, 0], [-1, 3**0.5, 0], [-1, -(3**0.5), 0]]),
    ],
)
def test_the_leader_has_the_foremost_central_place(
    pattern: str, expected: list[list[float]]
) -> None:
    settings = read_follow_settings((GOOD | {"pattern": pattern, "spacing": 2}).get)
    np.testing.assert_allclose(settings.config.offsets, expected, atol=1e-12)


def test_parameters_arrive_where_they_belong() -> None:
    given = {
        "followers": ["a", "/b/"],
        "leader": "/boat",
        "leader_topic": "/boat/pose",
        "offsets": [[-2, 1, 0.5], [-2, -1, 1]],
        "frame": "world",
        "assign": False,
        "lowest": 1.5,
        "min_separation": 0.8,
        "end_when_still": 6,
        "give_up": 20,
        "bandwidth": 4,
        "v_max": 2.0,
        "a_max": 2.5,
        "closing_speed": 0.5,
        "yaw_rate_max": 0.7,
        "yaw_deg": 90,
        "climb": 1.0,
        "ground_time": 2.0,
        "period": 0.2,
        "leader_timeout": 3,
        "guard": True,
    }
    settings = read_follow_settings(given.get)
    config = settings.config
    assert (settings.leader, settings.leader_topic) == ("boat", "/boat/pose")
    assert [vehicle.name for vehicle in settings.followers] == ["a", "b"]
    np.testing.assert_array_equal(config.offsets, [[-2, 1, 0.5], [-2, -1, 1]])
    assert (config.frame, config.assign, config.lowest_m) == ("world", False, 1.5)
    assert (config.min_separation_m, config.end_when_still_s, config.give_up_s) == (0.8, 6, 20)
    reference = config.reference
    assert (reference.bandwidth, reference.v_max, reference.a_max) == (4.0, 2.0, 2.5)
    assert (reference.closing_speed, reference.yaw_rate_max) == (0.5, 0.7)
    assert (config.plan.climb_m, config.plan.ground_s) == (1.0, 2.0)
    assert config.plan.yaw_rad == pytest.approx(math.pi / 2)
    assert settings.fleet.feed.period_ns == 200_000_000
    assert (settings.fleet.guard, settings.leader_timeout_s) == (True, 3.0)


@pytest.mark.parametrize(
    ("change", "what"),
    [
        ({"followers": None}, r"vehicles: \[\]; legal: different names"),
        ({"followers": "UAV2 UAV2"}, "legal: different names"),
        ({"leader": "UAV3"}, "followers: UAV3 is the leader; legal: other vehicles"),
        ({"offsets": [[0, 1, 2]]}, r"offsets: \[\[0, 1, 2\]\]; legal: \[x, y, z\] .* 3 followers"),
        ({"offsets": "wedge"}, "offsets: 'wedge'; legal"),
        ({"pattern": "star"}, "pattern: 'star'; legal: line, wedge, circle, grid"),
        ({"pattern": 3}, "pattern: 3; legal: a text"),
        ({"spacing": 0.4}, "offsets: counted from the leader, places 1 and 2 are 0.400 m apart"),
        ({"frame": "body"}, "frame: 'body'; legal: heading, world"),
        ({"bandwidth": 0}, "bandwidth: 0.0; legal: finite, greater than 0"),
        ({"leader_timeout": 0}, "leader_timeout: 0.0; legal: greater than 0"),
        ({"period": 5}, "period: 5 s; legal: 0.05 to 1 s"),
        ({"lowest": "high"}, "lowest: 'high'; legal: a number"),
    ],
)
def test_bad_parameters_are_refused(change: dict[str, Any], what: str) -> None:
    with pytest.raises(FormationError, match=what):
        read_follow_settings((GOOD | change).get)
