# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The forest: what stands on its hills, and their map."""

from __future__ import annotations

import io
import math
import warnings
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from trident_sim.occupancy import FREE, OCCUPIED, UNKNOWN, MapConfig
from trident_sim.terrain_map import map_above_ground
from trident_worldgen.forest import plants_of, terrain_of
from trident_worldgen.sdf import write_files

import trident_sim
from trident_worldgen import ForestConfig, forest

SHIPPED = Path(__file__).resolve().parents[3] / "worlds" / "forest.world"
BOX = """<sdf version="1.6"><model name="box"><link name="link">
  <inertial><mass>1</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial>
  <collision name="c"><geometry><box><size>0.3 0.3 0.1</size></box></geometry></collision>
</link></model></sdf>"""


@pytest.fixture(scope="module")
def shipped() -> trident_sim.World:
    """The forest of seed 1; loading it warns of nothing."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return trident_sim.World(SHIPPED)


def ground_at(world: trident_sim.World, x: float, y: float) -> float:
    """Height of the terrain, by the rays that lidars cast."""
    place, left = 50.0, 50
    while left:
        hits = world.cast_rays([[x, y, place]], [[0.0, 0.0, -1.0]])
        place -= hits.distance[0]
        if hits.shapes[hits.shape[0]].name == "terrain":
            return float(place)
        place, left = place - 1e-4, left - 1
    raise AssertionError(f"no terrain at {x}, {y}")


def test_the_terrain_is_as_the_generator_knows_it(shipped: trident_sim.World) -> None:
    terrain = terrain_of(ForestConfig())
    random = np.random.default_rng(5)
    for x, y in random.uniform(-19.9, 19.9, (200, 2)):
        assert terrain.height(x, y) == pytest.approx(ground_at(shipped, x, y), abs=1e-5)
    heights = [terrain.height(x, y) for x, y in random.uniform(-20, 20, (2000, 2))]
    assert 1.2 < np.ptp(heights) <= 2.0, "hills"
    assert [terrain.height(x, y) for x, y in ((0, 0), (2, 0), (-1, -2))] == pytest.approx(
        [0.0] * 3, abs=1e-4
    ), "a level clearing"


@pytest.mark.parametrize("seed", [1, 2, 44])
def test_trees_keep_their_distance_and_leave_the_clearing(seed: int) -> None:
    config = ForestConfig(seed=seed)
    plants = plants_of(config)
    trees = np.array([(plant.x, plant.y) for plant in plants if plant.height > 0.0])
    rocks = [plant for plant in plants if plant.height == 0.0]
    assert len(trees) == config.trees
    assert len(rocks) == config.rocks
    apart = np.linalg.norm(trees[:, None] - trees[None], axis=2) + 1e3 * np.eye(len(trees))
    assert apart.min() >= config.spacing
    assert np.hypot(*trees.T).min() >= config.clearing
    assert np.abs(trees).max() <= 19.0


def test_there_are_fewer_trees_where_there_is_no_room() -> None:
    config = ForestConfig(length=10.0, width=10.0, relief=1.0, clearing=2.0, trees=5000, rocks=0)
    assert 5 < len(plants_of(config)) < 30


def test_trees_stand_in_the_ground(shipped: trident_sim.World) -> None:
    plants = [plant for plant in plants_of(ForestConfig()) if plant.height > 0.0]
    for plant in plants[::10]:
        foot = ground_at(shipped, plant.x, plant.y)
        side = np.array([plant.x + 2.0, plant.y, foot + 0.3])
        hits = shipped.cast_rays([side], [[-1.0, 0.0, 0.0]])
        assert hits.distance[0] == pytest.approx(2.0 - plant.radius, abs=1e-3)
        assert "trunk" in hits.shapes[hits.shape[0]].name
        below = shipped.cast_rays([[plant.x, plant.y, foot - 0.1]], [[1.0, 0.0, 0.0]])
        assert below.distance[0] <= plant.radius + 1e-4, "its foot is not in the air"


def test_things_rest_on_the_hills() -> None:
    world = trident_sim.World(SHIPPED)
    terrain = terrain_of(ForestConfig())
    plants = plants_of(ForestConfig())
    random = np.random.default_rng(3)
    places = [
        (x, y)
        for x, y in [(0.0, 0.0), *random.uniform(-18.0, 18.0, (20, 2))]
        if all(math.hypot(x - plant.x, y - plant.y) > 0.8 for plant in plants)
    ]
    assert len(places) > 10
    boxes = [
        world.spawn(f"box{index}", sdf=BOX, pose=(x, y, terrain.height(x, y) + 0.15))
        for index, (x, y) in enumerate(places)
    ]
    world.step(1500)
    for box, (x, y) in zip(boxes, places, strict=True):
        at = box.position
        assert np.hypot(at[0] - x, at[1] - y) < 0.05
        assert at[2] == pytest.approx(terrain.height(at[0], at[1]) + 0.05, abs=0.01)


def test_level_ground_is_level(tmp_path: Path) -> None:
    files = forest(ForestConfig(length=12.0, width=16.0, relief=0.0, trees=4, rocks=1))
    picture = np.asarray(Image.open(io.BytesIO(bytes(files["models/forest_parts/terrain.png"]))))
    assert picture.shape == (129, 129)
    write_files(files, tmp_path)
    world = trident_sim.World(tmp_path / "forest.world", folders=[tmp_path / "models"])
    assert ground_at(world, 5.9, -7.9) == pytest.approx(0.0, abs=2e-3)


def test_the_map_of_a_forest_is_its_trunks_and_rocks(shipped: trident_sim.World) -> None:
    config = MapConfig(heights=(0.15,), reach=30.0)
    grid = map_above_ground(shipped, config)
    trees = [plant for plant in plants_of(ForestConfig()) if plant.height > 0.0]
    for plant in trees:
        assert grid.at(plant.x, plant.y) == OCCUPIED
        for turn in np.arange(8) * math.pi / 4:
            reach = plant.radius + 0.08
            inner = grid.at(plant.x + 0.05 * math.cos(turn), plant.y + 0.05 * math.sin(turn))
            assert inner == OCCUPIED
            outer = grid.at(plant.x + reach * math.cos(turn), plant.y + reach * math.sin(turn))
            assert outer == FREE or len(trees) < len(plants_of(ForestConfig()))
    area = np.count_nonzero(grid.cells == OCCUPIED) * grid.resolution**2
    trunks = sum(math.pi * plant.radius**2 for plant in trees)
    assert trunks < area < 2.0 * trunks, "crowns and hills are no obstacles"
    free = np.count_nonzero(grid.cells == FREE) * grid.resolution**2
    assert free + area == pytest.approx(1600.0, abs=1.0)
    assert grid.at(20.2, 0.0) == UNKNOWN, "beyond the edge"
