# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from trident_base.params import Recorded
from trident_fleet.core.errors import FormationError
from trident_fleet.core.station.settings import read_station_settings

REPO = Path(__file__).resolve().parents[4]
PAGE = REPO / "docs" / "reference" / "parameters" / "base_station.md"
GOOD: dict[str, Any] = {"links": "usv1, shore", "fence": [[0, 0], [50, 0], [50, 50]]}


def test_little_has_to_be_given() -> None:
    settings = read_station_settings(GOOD.get)
    assert settings.vehicle.prefix == "/uav1/"
    assert settings.links == ["usv1", "shore"]
    assert settings.pose_topics == {
        "usv1": "/uav1/from/usv1/odom",
        "shore": "/uav1/from/shore/odom",
    }
    assert settings.own_pose == "/uav1/odometry_sensor1/odometry"
    assert settings.status_ns == 500_000_000
    assert settings.datum is None
    assert settings.config.return_battery == 0.25


def test_parameters_arrive_where_they_belong() -> None:
    given = GOOD | {
        "vehicle": "/UAV7/",
        "places": {"shore": [1, 2, 3.5]},
        "poses": {"usv1": "/team/usv1/pose"},
        "pose_topic": "fix",
        "avoid": ["uav2"],
        "datum": [63.0, 10.0, 5.0],
        "lowest": 12,
        "highest": 40,
        "status_rate": 5,
        "v_max": 7.0,
        "margin": 2,
        "separation": 9.0,
        "shadow_sigma": 4.0,
        "survey_time": 100.0,
        "search_places": 500,
        "yaw_deg": 180,
        "lost_link": 12.0,
        "connect_wait": 3.0,
    }
    settings = read_station_settings(given.get)
    assert settings.vehicle.name == "UAV7"
    np.testing.assert_array_equal(settings.places["shore"], [1.0, 2.0, 3.5])
    assert settings.pose_topics == {"usv1": "/team/usv1/pose", "uav2": "/UAV7/from/uav2/fix"}
    assert (settings.fence.lowest_m, settings.fence.highest_m) == (12.0, 40.0)
    assert settings.status_ns == 200_000_000
    config = settings.config
    assert (config.pilot.v_max, config.pilot.margin_m, config.pilot.separation_m) == (7.0, 2.0, 9.0)
    assert (config.links.shadow_sigma_db, config.search.survey_s) == (4.0, 100.0)
    assert (config.search.places, config.lost_link_s) == (500, 12.0)
    assert config.yaw_rad == pytest.approx(math.pi)
    assert settings.fleet.connect_wait_s == 3.0
    assert settings.datum is not None
    assert settings.datum.height_m == 5.0


@pytest.mark.parametrize(
    ("change", "what"),
    [
        ({"links": None}, r"links: \[\]; legal: one or more other robots"),
        ({"links": "usv1 usv1"}, "links: .*legal: one or more other robots"),
        ({"links": "uav1"}, "legal: one or more other robots"),
        ({"fence": None}, r"fence: None; legal: 3 or more corners \[x, y\]"),
        ({"fence": [[0, 0], [1]]}, "legal: 3 or more corners"),
        ({"fence": [[0, 0], [9, 9], [9, 0], [0, 9]]}, "whose sides do not cross"),
        ({"lowest": 40}, "highest: 30 m; legal: above lowest, 40 m"),
        ({"places": {"shor": [1, 2, 3]}}, "places: shor; legal: usv1, shore; did you mean 'shore'"),
        ({"places": {"shore": [1, 2]}}, r"places/shore: \[1, 2\]; legal: \[x, y, z\]"),
        ({"places": [1, 2]}, r"places: \[1, 2\]; legal: a map, by names of robots"),
        ({"poses": {"usv1": 3}}, "poses/usv1: 3; legal: the name of a topic"),
        ({"status_rate": 3}, "status_rate: 3 Hz; legal: one whose period is a multiple of period"),
        ({"status_rate": 0}, "status_rate: 0 Hz, legal: 0.2 to 20 Hz"),
        ({"datum": [95, 0, 0]}, "datum latitude: 95 deg, legal: -90 to 90 deg"),
        ({"datum": "here"}, "datum: 'here'; legal: \\[latitude, longitude, height\\]"),
        ({"v_max": 0}, "v_max: 0.0; legal: finite, greater than 0"),
        ({"separation": -1}, "separation_m: -1.0; legal: finite, 0 or more"),
        ({"return_battery": 25}, "return_battery: 25, legal: 0 to 1"),
        ({"search_places": 5}, "search_places: 5, legal: 20 to 20000"),
        ({"survey_time": "long"}, "survey_time: 'long'; legal: a number"),
        ({"level": 500}, "level: 500 dB, legal: -100 to 200 dB"),
    ],
)
def test_bad_parameters_are_refused(change: dict[str, Any], what: str) -> None:
    with pytest.raises(FormationError, match=what):
        read_station_settings((GOOD | change).get)


@pytest.mark.parametrize("path", sorted((REPO / "config" / "stations").glob("*.yaml")))
def test_files_that_ship_are_legal(path: Path) -> None:
    given = yaml.safe_load(path.read_text(encoding="utf-8"))
    get = Recorded(given.get)
    read_station_settings(get)
    assert set(given) <= get.asked


def test_the_page_of_parameters_has_all_of_them() -> None:
    get = Recorded(GOOD.get)
    read_station_settings(get)
    text = PAGE.read_text(encoding="utf-8")
    documented = set(re.findall(r"^\| `~(\w+)` \|", text, re.MULTILINE))
    assert documented == get.asked
