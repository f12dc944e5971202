# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Routes, tours, pieces and lanes."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from small import config, scene
from trident_fleet.core.missions.blocks import Blocks
from trident_fleet.core.missions.kinds import Kind
from trident_fleet.core.missions.pieces import Lanes, pieces_of
from trident_fleet.core.missions.routes import Routes
from trident_fleet.core.missions.tour import short_order
from trident_fleet.core.missions.vehicle import KinematicVehicle
from trident_fleet.core.search.area import Lattice, SearchArea
from trident_fleet.core.search.coverage import Coverage
from trident_fleet.core.search.detection import Eye


def walled() -> SearchArea:
    """Land with a wall that leaves a gap in the north."""
    lattice = Lattice(30, 40, 2.0, (-40.0, -30.0))
    land = np.ones(lattice.shape, dtype=bool)
    free = land.copy()
    free[:25, 19:21] = False
    return SearchArea(lattice, land, ~land, free, ~land, np.ones(lattice.shape))


def test_paths_go_around_what_is_in_between_and_are_tight() -> None:
    routes = Routes(walled(), "ground")
    start, goal = (-20.0, -20.0), (20.0, -20.0)
    path = [start, *routes.path(start, goal)]
    assert path[-1] == goal
    assert all(routes.is_clear(one, other) for one, other in itertools.pairwise(path))
    length = sum(math.dist(one, other) for one, other in itertools.pairwise(path))
    around = 2.0 * math.dist(start, (-3.0, 21.0)) + 6.0
    assert length <= 1.03 * around
    assert length <= routes((*start, 0.0), (*goal, 0.0)) + 3.0
    assert Routes(walled(), "air").path(start, goal) == [goal]


def test_what_is_not_reached_is_approached() -> None:
    routes = Routes(walled(), "ground")
    path = routes.path((-20.0, -20.0), (0.0, -20.0))
    assert math.dist(path[-1], (0.0, -20.0)) < 4.0
    assert routes.reaches(path[-1])
    cut = walled()
    cut.ground[25:, 19:21] = False
    assert Routes(cut, "ground").path((-20.0, -20.0), (20.0, -20.0)) == []


@given(st.lists(st.tuples(st.floats(0, 100), st.floats(0, 100)), min_size=2, max_size=9))
def test_orders_get_shorter_and_keep_all(places: list[tuple[float, float]]) -> None:
    lengths = [[math.dist(one, other) for other in places] for one in places]

    def length(order: list[int]) -> float:
        nodes = [0, *(number + 1 for number in order)]
        return sum(lengths[a][b] for a, b in itertools.pairwise(nodes))

    order = short_order(lengths, 1)
    assert sorted(order) == list(range(len(places) - 1))
    assert order[0] == 0, "the first one is fixed"
    assert length(order) <= length(list(range(len(places) - 1))) + 1e-9


def test_a_crossed_tour_is_uncrossed() -> None:
    places = [(0.0, 0.0), (10.0, 0.0), (30.0, 0.0), (20.0, 0.0), (40.0, 0.0)]
    lengths = [[math.dist(one, other) for other in places] for one in places]
    assert short_order(lengths, 0) == [0, 2, 1, 3]


def test_pieces_fill_the_area_and_keep_to_one_side_of_the_shore() -> None:
    area = scene().area
    pieces = pieces_of(area, 33.0, 56.0)
    count = np.zeros(area.lattice.shape, dtype=int)
    for piece in pieces:
        rows, columns = piece.cells(area)
        count[rows, columns] += 1
        assert piece.wet == (not area.land[rows, columns].any())
    assert count.min() == 1
    assert count.max() <= 2, "a row of cells that two bands share"


@pytest.mark.parametrize("name", ["uav", "ugv", "usv"])
def test_lanes_cover_their_piece(name: str) -> None:
    area, kind = scene().area, config().kinds[name]
    routes, eye = Routes(area, kind.domain), Eye(area, kind.sensor)
    piece = next(
        one
        for one in pieces_of(area, kind.lane_land_m, kind.lane_water_m)
        if one.wet == (name == "usv") and one.x[0] < 0.0
    )
    coverage = Coverage(area.lattice)
    vehicle = KinematicVehicle(piece.place, kind.speed_m_s)
    lanes = Lanes(area, kind, routes)
    path = lanes.path(piece, vehicle.place, coverage.lacks_s(eye))
    assert sum(map(math.dist, path, path[1:])) <= 1.3 * lanes.work_m(piece)
    vehicle.follow([path[0]])
    while vehicle.path_left:
        vehicle.step(0.5)
    vehicle.follow(path)
    while vehicle.path_left:
        vehicle.step(0.5)
        coverage.see(eye, eye.view(*vehicle.place), 0.5)
    rows, columns = piece.cells(area)
    seen = coverage.covered()[rows, columns]
    visible = (eye.cover_rate > 0.0)[rows, columns]
    assert seen[visible].mean() > 0.85, "what is left at its ends the next pieces cover"
    assert lanes.path(piece, vehicle.place, np.zeros(area.lattice.shape)) == []


def test_blocks_lead_to_where_something_is_to_be_gained() -> None:
    area = scene().area
    kind: Kind = config().kinds["uav"]
    need = np.zeros(area.lattice.shape)
    assert Blocks.of(area, kind).path((0.0, 0.0), need, Routes(area, "air")) == []
    need[50:55, 70:75] = 1.0
    path = Blocks.of(area, kind).path((0.0, 0.0), need, Routes(area, "air"))
    x, y = area.lattice.middle(52, 72)
    assert math.dist(path[-1], (float(x), float(y))) < 20.0
