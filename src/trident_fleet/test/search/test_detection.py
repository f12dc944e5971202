# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scenes import LATTICE, coast
from trident_fleet.core.search.area import SearchError
from trident_fleet.core.search.coverage import Coverage
from trident_fleet.core.search.detection import Eye, Sensor, chance, weather_factor
from trident_fleet.core.search.sightings import Look, LookPart, Sightings

UAV = Sensor(18.0, 25.0, 0.5, 0.75, 0.45, from_above=True)
UGV = Sensor(15.0, 1.5, 0.4, 0.6, 0.6)


def test_a_view_is_a_disc_around_the_robot() -> None:
    view = Eye(coast(), UGV).view(50.0, 30.0)
    x, y = LATTICE.middle(view.row, view.column)
    assert np.hypot(x - 50.0, y - 30.0).max() <= 15.0
    assert len(x) == pytest.approx(math.pi * 15.0**2 / 4.0, rel=0.05)


def test_what_is_covered_is_hidden_from_above_and_not_from_the_ground() -> None:
    area = coast()
    x, y = (float(value) for value in LATTICE.middle(44, 14))
    assert not area.covered[Eye(area, UAV).view(x, y).mask(LATTICE.shape)].any()
    seen = Eye(area, UGV).view(x, y).mask(LATTICE.shape)
    assert seen[area.covered].all()


def test_a_house_hides_what_lies_behind_it() -> None:
    area = coast()
    x, y = (float(value) for value in LATTICE.middle(42, 38))
    seen = Eye(area, UGV).view(x, y).mask(LATTICE.shape)
    assert not seen[42, 46:].any(), "behind the house"
    assert seen[42, 31:38].all(), "on the other side"
    tall = Eye(area, replace(UGV, height_m=20.0)).view(x, y).mask(LATTICE.shape)
    assert tall[42, 38:45].all(), "a tall eye sees over it"


def test_detection_in_time_is_exponential_and_as_often_as_the_model_says() -> None:
    trials = 20_000
    for seconds, expected in ((1.0, 0.4), (0.5, 1.0 - math.sqrt(0.6))):
        rate = -math.log(1.0 - UGV.detect)
        hits = sum(
            chance(3, "ugv", f"casualty_{one}", 7) < 1.0 - math.exp(-rate * seconds)
            for one in range(trials)
        )
        assert hits / trials == pytest.approx(expected, abs=0.01)


def test_chance_depends_on_all_that_it_is_said_to_and_nothing_else() -> None:
    one = chance(1, "uav1", "casualty_0", 5)
    assert one == chance(1, "uav1", "casualty_0", 5)
    others = {
        chance(2, "uav1", "casualty_0", 5),
        chance(1, "ugv1", "casualty_0", 5),
        chance(1, "uav1", "casualty_1", 5),
        chance(1, "uav1", "casualty_0", 6),
    }
    assert len(others | {one}) == 5


def test_cells_are_covered_after_the_time_that_the_model_says() -> None:
    area = coast()
    eye, coverage = Eye(area, UAV), Coverage(LATTICE)
    view = eye.view(0.0, 0.0)  # on the shore
    seen = view.mask(LATTICE.shape)
    coverage.see(eye, view, 1.7)  # 0.25^1.7 < 0.1
    np.testing.assert_array_equal(coverage.covered(), seen & area.land)
    assert coverage.lacks_s(eye)[seen & ~area.land] == pytest.approx(
        math.log(10.0) / -math.log(0.55) - 1.7
    )
    coverage.see(eye, view, 2.2)  # 0.55^3.9 < 0.1
    np.testing.assert_array_equal(coverage.covered(), seen)
    assert coverage.share() == seen.mean()
    assert (
        np.isinf(coverage.lacks_s(eye)[area.covered]).any()
        or (coverage.lacks_s(eye)[area.covered] > 1e9).all()
    )
    assert coverage.seen().max() <= 1.0


def test_rough_seas_make_people_in_the_water_harder_to_see() -> None:
    assert [weather_factor(height) for height in (0.3, 1.2, 2.0)] == [1.0, 0.5, 0.25]
    calm, rough = Eye(coast(), UAV), Eye(coast(), UAV, wave_height_m=1.2)
    assert rough.detect_rate[0, 0] == 0.5 * calm.detect_rate[0, 0]
    assert rough.detect_rate[-1, -1] == calm.detect_rate[-1, -1], "not on land"


def test_sightings_come_whole_whatever_is_lost_or_doubled() -> None:
    random = np.random.default_rng(5)
    own, others = Sightings(LATTICE), Sightings(LATTICE)
    heard: list[tuple[str, Look]] = []
    late: list[LookPart] = []
    for number in range(200):
        x, y = random.uniform(-79.0, 79.0), random.uniform(-59.0, 59.0)
        own.add("uav1", Look(0.5 * number, x, y))
        for part in own.difference(others.counts()):
            late.append(part)
            if random.random() < 0.6:
                others.merge(part, lambda robot, look: heard.append((robot, look)))
        if random.random() < 0.3:
            old = late[int(random.integers(len(late)))]
            others.merge(old, lambda robot, look: heard.append((robot, look)))
    for part in own.difference(others.counts()):
        others.merge(part, lambda robot, look: heard.append((robot, look)))
    assert list(others.looks()) == list(own.looks()) == heard
    assert own.difference(others.counts()) == []


@given(st.floats(0.0, 3000.0), st.floats(-80.0, 80.0), st.floats(-60.0, 60.0))
def test_looks_are_rounded_once(time_s: float, x: float, y: float) -> None:
    first, second, third = (Sightings(LATTICE) for _ in range(3))
    look = first.add("a", Look(time_s, x, y))
    assert abs(look.time_s - time_s) <= 0.026
    assert math.hypot(look.x - x, look.y - y) <= 0.01
    for source, goal in ((first, second), (second, third)):
        for part in source.difference(goal.counts()):
            goal.merge(part, lambda robot, look: None)
    assert list(third.looks()) == [("a", look)]


def test_bad_input_names_what_is_wrong() -> None:
    with pytest.raises(SearchError, match=r"range_m is 0.0, legal: above 0"):
        replace(UAV, range_m=0.0)
    with pytest.raises(SearchError, match=r"detect is 1.0, legal: 0 to below 1"):
        replace(UAV, detect=1.0)
    with pytest.raises(SearchError, match="place is nan"):
        Eye(coast(), UAV).view(float("nan"), 0.0)
    with pytest.raises(SearchError, match="5 bytes, legal: 8 and 6 for each look"):
        Sightings(LATTICE).merge(LookPart("a", 0, b"12345"), lambda robot, look: None)
    eye = Eye(coast(), UAV)
    with pytest.raises(SearchError, match=r"seconds is -1.0, legal: finite, from 0"):
        Coverage(LATTICE).see(eye, eye.view(0.0, 0.0), -1.0)
