# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import itertools

import numpy as np
import pytest
from trident_benchmarks.datasets.route import Roads, RoutePilot, straightened
from trident_eval.core.errors import EvalError

occupancy = pytest.importorskip(
    "trident_sim.occupancy", reason="trident_sim is not built or sourced"
)


def two_rooms() -> occupancy.OccupancyMap:
    """8 m x 4 m with a wall in the middle, whose door is 1 m wide."""
    cells = np.full((80, 160), occupancy.FREE, np.int8)
    cells[[0, -1]] = occupancy.OCCUPIED
    cells[:, [0, -1]] = occupancy.OCCUPIED
    cells[:60, 79:81] = occupancy.OCCUPIED
    return occupancy.OccupancyMap(cells, 0.05, (-4.0, -2.0))


def test_a_tour_sees_every_place_and_leads_back_without_touching_a_wall() -> None:
    grid = two_rooms()
    roads = Roads(grid)
    path = roads.tour(0, 2.0)
    assert path[0] == pytest.approx(path[-1])
    steps = [np.linspace(a, b, 50) for a, b in itertools.pairwise(path)]
    points = np.concatenate(steps)
    offset = roads.places[:, None] - path[None]
    assert np.linalg.norm(offset, axis=2).min(axis=1).max() < 2.0
    for angle in np.linspace(0.0, 2.0 * np.pi, 12):
        around = points + 0.2 * np.array([np.cos(angle), np.sin(angle)])
        assert all(grid.at(x, y) == occupancy.FREE for x, y in around)


def test_seeds_take_different_paths_and_one_seed_the_same() -> None:
    roads = Roads(two_rooms())
    assert np.array_equal(roads.tour(1, 2.0), roads.tour(1, 2.0))
    assert not np.array_equal(roads.tour(1, 2.0)[0], roads.tour(2, 2.0)[0])


def test_a_map_without_room_is_an_error() -> None:
    cells = np.full((9, 9), occupancy.OCCUPIED, np.int8)
    with pytest.raises(EvalError, match="no place with"):
        Roads(occupancy.OccupancyMap(cells, 0.05, (0.0, 0.0)))


def test_a_straightened_path_keeps_its_corners() -> None:
    line = np.linspace([0.0, 0.0], [4.0, 0.0], 41)
    corner = np.concatenate((line, np.linspace([4.0, 0.0], [4.0, 3.0], 31)[1:], line[-2::-1]))
    found = straightened(corner, 0.05)
    assert found.tolist() == [[0, 0], [4, 0], [4, 3], [3.9, 0], [0, 0]]


def test_the_pilot_commands_at_its_own_rate_and_ends() -> None:
    pilot = RoutePilot([[0.0, 0.0], [1.0, 0.0]])
    first = pilot.command(0.0, np.array([0.0, 0.0, 0.0]), None)
    assert first is not None
    assert pilot.command(0.01, np.array([0.0, 0.0, 0.0]), None) is None
    assert not pilot.is_done
    pilot.command(0.06, np.array([0.5, 0.0, 0.0]), None)
    assert pilot.command(3.0, np.array([0.95, 0.0, 0.0]), None) == (0.0, 0.0)
    assert pilot.is_done
