# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scenes import LATTICE, coast
from trident_fleet.core.search.area import Lattice, SearchError
from trident_fleet.core.search.belief import Belief, Prior
from trident_fleet.core.search.detection import Eye, Sensor
from trident_fleet.core.search.drift import LEEWAYS, Flow, Sea, leeway_named, random_leeways

SEA = Sea(current=(0.1, 0.0), wind=(4.4, -2.4))
EYE = Sensor(18.0, 25.0, 0.5, 0.75, 0.45, from_above=True)


def coarse(grid: np.ndarray) -> np.ndarray:
    """Summed up to cells of 10 m."""
    rows, columns = grid.shape
    return np.asarray(grid.reshape(rows // 5, 5, columns // 5, 5).sum(axis=(1, 3)))


@pytest.mark.parametrize("kind", LEEWAYS)
def test_drift_is_that_of_a_hundred_thousand_people(kind: str) -> None:
    lattice = Lattice(120, 160, 2.0, (-160.0, -120.0))
    area = coast(lattice)
    sea = Sea(SEA.current, SEA.wind, leeway_named(kind))
    x, y = lattice.middle(*np.indices(lattice.shape))
    prior = np.exp(-((x + 60.0) ** 2 + (y + 60.0) ** 2) / (2.0 * 30.0**2)) * ~area.land
    belief, random = Belief(area, prior, sea), np.random.default_rng(2)
    cells = random.choice(prior.size, 100_000, p=prior.ravel() / prior.sum())
    places = np.column_stack(lattice.middle(*np.divmod(cells, lattice.columns)))
    places = places + random.uniform(-1.0, 1.0, places.shape)
    leeways, flow = random_leeways(sea, len(places), random), Flow(area, sea)
    for time_s in range(60, 601, 60):
        belief.drift(float(time_s))
        places = flow.moved(places, leeways, 60.0)
    counts = np.zeros(lattice.shape)
    np.add.at(counts, lattice.cell(*places.T), 1e-5)
    people, grid = coarse(counts), coarse(belief.grid())
    there = people > 0.0
    divergence = people[there] * np.log(people[there] / np.maximum(grid[there], 1e-12))
    assert divergence.sum() <= 0.02


@settings(max_examples=20, deadline=None)
@given(
    st.lists(
        st.tuples(st.floats(-80.0, 80.0), st.floats(-60.0, 60.0), st.floats(0.0, 20.0)), max_size=8
    )
)
def test_whatever_is_seen_belief_sums_to_one(looks: list[tuple[float, float, float]]) -> None:
    area = coast()
    belief, eye = Belief(area, Prior().grid(area), SEA, 1 << 10), Eye(area, EYE)
    for number, (x, y, seconds) in enumerate(looks, start=1):
        belief.miss(eye, eye.view(x, y), seconds)
        belief.drift(10.0 * number)
        grid = belief.grid()
        assert abs(grid.sum() - 1.0) < 1e-6
        assert (grid >= 0.0).all()


def test_a_miss_is_bayes_rule() -> None:
    area = coast()
    prior = Prior(open_land=1.0, covered=0.0, water=0.0).grid(area)
    belief, eye = Belief(area, prior, SEA), Eye(area, EYE)
    view = eye.view(10.0, 40.0)
    seen = view.mask(LATTICE.shape)
    chance = prior[seen].sum() * 0.75  # two seconds at 0.5 per second
    assert belief.miss(eye, view, 2.0) == pytest.approx(chance)
    np.testing.assert_allclose(belief.grid()[seen], prior[seen] * 0.25 / (1.0 - chance))
    np.testing.assert_allclose(belief.grid()[~seen], prior[~seen] / (1.0 - chance))


def test_what_has_been_searched_drifts_along() -> None:
    area = coast()
    prior = Prior(open_land=0.0, covered=0.0, water=1.0).grid(area)
    sea = Sea(current=(0.2, 0.0))
    belief, eye = Belief(area, prior, sea), Eye(area, EYE)
    belief.miss(eye, eye.view(-40.0, -30.0), 30.0)
    belief.drift(200.0)
    row, column = LATTICE.cell(np.array([-40.0, 0.0]), np.array([-30.0, -30.0]))
    before, behind = belief.grid()[row, column]
    assert behind < 0.2 * before, "those who were seen not to be there have moved 40 m east"


def test_people_ashore_stay_there() -> None:
    area = coast()
    flow = Flow(area, Sea(wind=(0.0, 5.0), leeway=leeway_named("person")))
    places = np.tile((0.0, -4.0), (500, 1))
    leeways = random_leeways(flow.sea, 500, np.random.default_rng(1))
    for _ in range(100):
        places = flow.moved(places, leeways, 5.0)
    assert places[:, 1].max() < 0.0
    assert (~area.land[LATTICE.cell(*places.T)]).all()


def test_leeway_is_that_of_the_tables() -> None:
    # At 10 m/s the residual's deviation is that of the list: 12 and 9.4 cm/s.
    leeways = random_leeways(
        Sea(wind=(0.0, 10.0), leeway=leeway_named("person")), 200_000, np.random.default_rng(4)
    )
    assert leeways[:, 1].mean() == pytest.approx(0.096, abs=2e-3)
    assert leeways[:, 1].std() == pytest.approx(0.12, rel=0.01)
    assert leeways[:, 0].mean() == pytest.approx(0.0, abs=2e-3), "as many to each side"
    assert leeways[:, 0].std() == pytest.approx(np.hypot(0.094, 0.054), rel=0.01)


def test_bad_input_names_what_is_wrong() -> None:
    area = coast()
    with pytest.raises(SearchError, match=r"prior: shape is \(3, 3\), legal: \(60, 80\)"):
        Belief(area, np.ones((3, 3)))
    with pytest.raises(SearchError, match="negative, NaN, or all 0"):
        Belief(area, np.full(LATTICE.shape, np.nan))
    belief = Belief(area, Prior().grid(area), SEA, 1 << 8)
    belief.drift(5.0)
    with pytest.raises(SearchError, match=r"time 4.0 s, legal: from 5.0 s"):
        belief.drift(4.0)
    with pytest.raises(SearchError, match="0 is left of it"):
        belief.multiply(np.zeros(LATTICE.shape))
    with pytest.raises(SearchError, match=r"likelihood: shape is \(2, 2\)"):
        belief.multiply(np.ones((2, 2)))
    with pytest.raises(SearchError, match=r"open_land is -1.0"):
        Prior(open_land=-1.0)
    with pytest.raises(SearchError, match="wind is"):
        Sea(wind=(float("nan"), 0.0))
    with pytest.raises(SearchError, match="leeway is 'raft', legal: person"):
        leeway_named("raft")
    with pytest.raises(SearchError, match=r"cell_m is 0.0, legal: finite, above 0"):
        Lattice(1, 1, 0.0, (0.0, 0.0))
