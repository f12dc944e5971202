# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from air import Flight, Link, free_space
from polygons import U_SHAPE
from trident_fleet.core.base_station import BaseStation, Phase
from trident_fleet.core.errors import FormationError
from trident_fleet.core.quintic import Array
from trident_fleet.core.station.config import PilotConfig, SearchConfig, StationConfig
from trident_fleet.core.station.fence import Fence

SQUARE = Fence(np.array([[-40.0, -40], [40, -40], [40, 40], [-40, 40]]), 15.0, 25.0)
HOME = np.array([-30.0, 30.0, 0.2])
CONFIG = StationConfig(
    pilot=PilotConfig(v_max=8.0, a_max=4.0),
    search=SearchConfig(survey_s=40.0, refine_s=20.0, places=300),
)
LONG = replace(CONFIG, search=SearchConfig(survey_s=120.0, refine_s=40.0, places=1000))
LINKS = ["boat", "mast"]


def at(x: float, y: float, z: float) -> Callable[[float], Array]:
    return lambda _: np.array([x, y, z])


STANDING = {"boat": at(60.0, -30.0, 2.0), "mast": at(-50.0, -35.0, 4.0)}


def flight(config: StationConfig = CONFIG, link: Link | None = None) -> Flight:
    station = BaseStation(SQUARE, config, HOME, LINKS)
    return Flight(station, dict(STANDING), link or free_space(), position=HOME)


def best_of_grid(flight: Flight) -> float:
    axes = [np.arange(-39, 39.1, 2), np.arange(-39, 39.1, 2), np.arange(16, 24.1, 2)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    return max(flight.worst_db(place) for place in grid)


def wall(position: Array, other: Array) -> float:
    """12 dB less where a wall stands between."""
    is_behind = other[0] < -40.0 and position[1] < -10.0
    return free_space()(position, other) - 12.0 * is_behind


def shadows(position: Array, other: Array) -> float:
    """Waves over both ends' places."""
    random = np.random.default_rng(7)
    k, phase = random.normal(0.0, 0.25, (12, 3)), random.uniform(0.0, 7.0, 12)
    waves = np.cos(k @ position + 3.0 * k @ other + phase).sum() * np.sqrt(2.0 / 12.0)
    return free_space()(position, other) + 3.0 * float(waves)


@pytest.mark.parametrize(
    ("config", "link", "short_db"),
    [(CONFIG, free_space(), 0.2), (LONG, wall, 0.3), (LONG, shadows, 1.0)],
    ids=["free space", "wall", "shadows"],
)
def test_it_holds_a_place_about_as_good_as_the_best_of_a_grid(
    config: StationConfig, link: Link, short_db: float
) -> None:
    found = flight(config, link)
    found.run(config.search.survey_s + config.search.refine_s + 35.0)
    assert found.names == ["on the ground", "take-off", "survey", "refine", "hold"]
    assert found.worst_db(found.position) >= best_of_grid(found) - short_db
    assert found.station.found_db == pytest.approx(found.worst_db(found.position), abs=0.3)


def test_it_stays_in_the_fence_once_it_is_in() -> None:
    found = flight(link=shadows)
    found.run(100.0)
    points = np.array(found.points)
    first = int(np.argmax(points[:, 2] >= 16.0 - 1e-6))
    assert SQUARE.clearance(points[first:]).min() >= 1.0 - 1e-5
    column = points[:first, :2] - HOME[:2]
    assert np.abs(column).max() < 1e-9


def test_the_same_is_heard_and_the_same_is_flown() -> None:
    first, second = flight(link=shadows), flight(link=shadows)
    first.run(40.0)
    second.run(40.0)
    np.testing.assert_array_equal(np.array(first.points), np.array(second.points))


def test_an_empty_battery_brings_it_home_from_wherever_it_is() -> None:
    found = flight()
    found.battery = lambda time_s: 0.9 - 0.02 * time_s
    found.run(35.0)
    assert found.station.phase is Phase.RETURN
    assert found.phases[-1][0] == pytest.approx((0.9 - 0.25) / 0.02, abs=0.5)
    found.run(45.0)
    assert found.names[-3:] == ["return", "land", "landed"]
    np.testing.assert_allclose(found.position, HOME, atol=1e-6)
    assert found.station.is_over
    assert found.station.reason == "battery at 25 %"


def test_without_any_link_it_flies_back_along_its_path_and_lands() -> None:
    found = flight()
    found.run(60.0)
    found.hears = lambda _: False
    lost_s = found.time_s
    found.run(200.0)
    assert found.names[-4:] == ["back along its path", "return", "land", "landed"]
    back_s = {phase: time_s for time_s, phase in found.phases}[Phase.BACK]
    assert back_s - lost_s < 6.0
    points = np.array(found.points)
    turn = round(back_s / 0.01)
    away = [np.linalg.norm(points[:turn] - point, axis=1).min() for point in points[turn::50]]
    assert max(away) < 2.5, "where it has been before"
    np.testing.assert_allclose(found.position, HOME, atol=1e-6)


def test_on_its_path_back_it_continues_when_it_hears_something() -> None:
    found = flight()
    found.run(30.0)
    found.hears = lambda time_s: not 30.0 < time_s < 38.0
    found.run(12.0)
    assert found.names[-2:] == ["back along its path", "survey"]


def test_it_follows_robots_that_move_and_searches_where_they_stop() -> None:
    found = flight()
    found.run(85.0)
    assert found.station.phase is Phase.HOLD
    held = found.position
    begin_s = found.time_s

    def moving(time_s: float) -> Array:
        return np.array([60.0 - 2.0 * min(max(time_s - begin_s, 0.0), 45.0), -30.0, 2.0])

    found.others["boat"] = moving
    found.run(45.0)
    assert found.station.phase is Phase.FOLLOW
    assert np.linalg.norm(found.position - held) > 20.0
    assert found.worst_db(found.position) > best_of_grid(found) - 2.5
    found.run(85.0)
    assert found.names[-4:] == ["follow", "survey", "refine", "hold"]
    assert found.worst_db(found.position) > best_of_grid(found) - 0.3


def test_a_place_that_has_become_bad_is_left() -> None:
    found = flight()
    found.run(80.0)
    assert found.station.phase is Phase.HOLD
    held = found.position.copy()

    def fog(position: Array, other: Array) -> float:
        near = float(np.exp(-(np.linalg.norm(position - held) ** 2) / 50.0))
        return free_space()(position, other) - 15.0 * near

    found.link = fog
    found.run(90.0)
    assert "dB instead of" not in found.station.reason
    assert found.names[-4:] == ["hold", "survey", "refine", "hold"]
    assert found.worst_db(found.position) > best_of_grid(found) - 1.0


def test_it_rises_in_the_middle_until_somebody_says_where_he_is() -> None:
    found = flight()
    found.know = False
    station = found.station
    found.run(20.0)
    assert station.phase is Phase.SURVEY
    assert station.reason == "no robot has said where it is"
    np.testing.assert_allclose(station.goal, [0.0, 0.0, 24.0])


def test_a_bay_of_the_fence_is_flown_around() -> None:
    fence = Fence(U_SHAPE, 10.0, 20.0)
    config = replace(CONFIG, search=replace(CONFIG.search, survey_s=60.0))
    home = np.array([20.0, 90.0, 0.0])
    found = Flight(BaseStation(fence, config, home, ["boat"]), {"boat": at(80.0, 130.0, 1.0)})
    found.position = home
    found.run(120.0)
    assert found.station.phase is Phase.HOLD
    assert found.position[0] > 60.0
    points = np.array(found.points)
    assert fence.clearance(points[points[:, 2] > 11.0]).min() >= 1.0 - 1e-5


@pytest.mark.parametrize(
    ("home", "fence", "what"),
    [
        ([50, 0, 0], SQUARE, r"fence: the UAV starts at \(50, 0\); legal: a polygon around that"),
        ([0, 0, 30], SQUARE, "lowest: 15 m; legal: above the start, 30 m"),
        ([0, 0, 0], replace(SQUARE, highest_m=16.5), "2 m high"),
    ],
)
def test_a_start_that_is_not_below_the_fence_is_refused(
    home: list[float], fence: Fence, what: str
) -> None:
    with pytest.raises(FormationError, match=what):
        BaseStation(fence, CONFIG, np.array(home, dtype=float), LINKS)
