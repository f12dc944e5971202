# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The coast and the regatta's course: land, a level road, water deep enough, moored buoys."""

from __future__ import annotations

import math
import warnings
from pathlib import Path

import numpy as np
import pytest
from trident_sim.occupancy import FREE, OCCUPIED, MapConfig
from trident_sim.terrain_map import map_above_ground
from trident_worldgen.buoys import Buoy, course_of
from trident_worldgen.coast import BASIN_M, BED_M, LAND_M, coast_ground, fairway

import trident_sim
from trident_worldgen import CoastConfig, RegattaConfig

WORLDS = Path(__file__).resolve().parents[3] / "worlds"


@pytest.fixture(scope="module")
def shipped() -> trident_sim.World:
    """The coast of seed 1; loading it warns of nothing."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return trident_sim.World(WORLDS / "coast.world")


@pytest.mark.parametrize("seed", [1, 2, 44])
def test_there_are_land_sea_and_a_level_road(seed: int) -> None:
    ground = coast_ground(CoastConfig(seed=seed))
    for x in range(-130, 131, 13):
        for y in (47.0, 50.0, 53.0):
            assert ground.height(float(x), y) == pytest.approx(LAND_M, abs=1e-3), "the road"
        assert ground.height(float(x), -120.0) < 0.7 * BED_M, "the sea"
    assert max(ground.height(float(x), 140.0) for x in range(-140, 141, 20)) > 8.0, "the hills"
    for x in range(5, 60, 5):
        assert ground.height(float(x), 10.0) == pytest.approx(BASIN_M, abs=1e-3), "the harbour"
        assert ground.height(float(x), -60.0) < -3.0, "its approach"


def test_the_harbour_is_closed_by_walls_to_the_south_only(shipped: trident_sim.World) -> None:
    above_water = np.array([30.0, 0.0, 0.5])
    away = {"east": (1.0, 0.0, 0.0), "west": (-1.0, 0.0, 0.0), "north": (0.0, 1.0, 0.0)}
    hits = shipped.cast_rays(np.tile(above_water, (3, 1)), list(away.values()))
    assert [hits.shapes[shape].model for shape in hits.shape] == ["harbour"] * 3
    assert hits.distance == pytest.approx([32.0, 32.0, 25.0], abs=1e-3)
    out = shipped.cast_rays([above_water], [[0.0, -1.0, 0.0]])
    assert out.shape[0] < 0 or out.distance[0] > 100.0


def test_its_map_has_the_road_free_and_houses_occupied(shipped: trident_sim.World) -> None:
    config = MapConfig(resolution=0.5, heights=(0.5,), start=(0.0, 50.0), reach=60.0)
    grid = map_above_ground(shipped, config)
    for x in range(-50, 51, 5):
        assert grid.at(float(x), 50.0) == FREE
    assert grid.at(0.0, 44.0) == OCCUPIED, "the shed"
    assert grid.at(48.0, 39.0) == OCCUPIED, "a container"


def _is_still_moored(buoy: Buoy, position: np.ndarray) -> None:
    away = math.hypot(position[0] - buoy.x, position[1] - buoy.y)
    # The line is 1.15 depths long, ends 0.5 m below the water, and lengthens a little.
    slack = math.sqrt((1.15 * buoy.depth) ** 2 - (buoy.depth - 0.5) ** 2)
    assert away < slack + 1.5, buoy.name
    assert abs(position[2]) < 0.5, buoy.name


@pytest.mark.parametrize("name", ["coast", "regatta"])
def test_buoys_float_upright_where_they_are_moored(name: str) -> None:
    world = trident_sim.World(WORLDS / f"{name}.world")
    buoys = fairway(coast_ground(CoastConfig())) if name == "coast" else course_of(RegattaConfig())
    assert len(buoys) >= 6
    world.step(round(20.0 / world.dt))
    for buoy in buoys:
        model = world.model(buoy.name)
        _is_still_moored(buoy, np.asarray(model.position))
        qx, qy = model.orientation[:2]
        assert 2.0 * math.hypot(qx, qy) < 0.4


def test_a_mooring_holds_a_float_against_a_push() -> None:
    world = trident_sim.World(WORLDS / "regatta.world")
    mark = next(buoy for buoy in course_of(RegattaConfig()) if buoy.name == "windward")
    world.model(mark.name).link("hull").apply_wrench((300.0, 0.0, 0.0))
    world.step(round(20.0 / world.dt))
    assert world.model(mark.name).position[0] > mark.x + 4.0
    _is_still_moored(mark, np.asarray(world.model(mark.name).position))


def test_a_mooring_without_length_is_refused() -> None:
    world = trident_sim.World("package://rotors_gazebo/worlds/empty.world")
    with pytest.raises(trident_sim.Error, match="length"):
        world.spawn(
            "float",
            sdf="<sdf version='1.6'><model name='float'><link name='hull'/>"
            "<plugin name='mooring' filename='libtrident_mooring.so'><bodyName>hull</bodyName>"
            "<anchor>0 0 -3</anchor></plugin></model></sdf>",
        )
