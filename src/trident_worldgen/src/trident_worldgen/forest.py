# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A forest on hills: trees and rocks about a clearing."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from trident_worldgen.checks import require, require_count, require_seed
from trident_worldgen.parts import model_config, rock_model
from trident_worldgen.placing import Range, free_place
from trident_worldgen.sdf import Color, Files, StaticModel, world_text
from trident_worldgen.shapes import cone, rock
from trident_worldgen.terrain import Terrain, hills

_FOLDER = "models/forest_parts"
_URI = "model://forest_parts"
_BARK = Color((0.36, 0.25, 0.16))
_NEEDLES = Color((0.1, 0.3, 0.16))
_LEAVES = Color((0.28, 0.45, 0.14))
_STONE = Color((0.45, 0.44, 0.42))
_GRASS = Color((0.33, 0.4, 0.2))
_ROOTS_M = 0.2  # how deep trunks stand in the ground, so that slopes show no gap
_EDGE_M = 1.0  # kept free along the border
_ROCK_GAP_M = 0.8
_TRIES = 60


@dataclass(frozen=True)
class ForestConfig:
    """Sizes of the forest [m].

    Attributes:
        seed: decides the hills, and what stands where.
        length: along x.
        width: along y.
        relief: between the lowest and the highest place; 0 is level ground.
        clearing: radius of the level ground in the middle, where robots begin.
        spacing: between trunks, at least.
        trees: how many; fewer where there is no room.
        rocks: how many; fewer where there is no room.
    """

    seed: int = 1
    length: float = 40.0
    width: float = 40.0
    relief: float = 2.0
    clearing: float = 3.0
    spacing: float = 2.2
    trees: int = 110
    rocks: int = 30

    def validate(self) -> None:
        """Raises Error naming the field, its value and what is legal."""
        require_seed(self.seed)
        require("length", self.length, 10.0, 200.0)
        require("width", self.width, 10.0, 200.0)
        require("relief", self.relief, 0.0, 0.15 * min(self.length, self.width))
        require("clearing", self.clearing, 1.0, 0.25 * min(self.length, self.width))
        require("spacing", self.spacing, 1.0, 20.0)
        require_count("trees", self.trees, 5000)
        require_count("rocks", self.rocks, 2000)


@dataclass(frozen=True)
class Plant:
    """A tree or a rock.

    Attributes:
        x: [m, world].
        y: [m, world].
        radius: of the trunk, or of the rock [m].
        height: of the tree; 0: a rock [m].
    """

    x: float
    y: float
    radius: float
    height: float


def forest(config: ForestConfig | None = None) -> Files:
    """`forest.world`, its terrain and its meshes.

    Raises:
        Error: an illegal configuration.
    """
    config = config or ForestConfig()
    config.validate()
    ground = terrain_of(config)
    model = StaticModel("forest")
    size = (config.length, config.width, ground.relief)
    model.heightmap("terrain", f"{_URI}/terrain.png", size, (0.0, 0.0, ground.lowest), _GRASS)
    random = _random(config, 0x7EE5)
    for index, plant in enumerate(plants_of(config)):
        if plant.height > 0.0:
            _tree(model, f"tree{index}", plant, ground, random)
        else:
            _rock(model, f"rock{index}", plant, ground, random)
    comment = (
        f"A forest of {config.length:g} m x {config.width:g} m on hills, level in its middle. "
        f"Made by ./trident worldgen forest, seed {config.seed}"
    )
    return {
        "forest.world": world_text(comment, [model], ground=False),
        f"{_FOLDER}/model.config": model_config(
            "forest_parts", "Terrain and meshes of the forest."
        ),
        f"{_FOLDER}/model.sdf": rock_model("forest_parts", "forest.world"),
        f"{_FOLDER}/terrain.png": ground.picture(),
        f"{_FOLDER}/meshes/cone.obj": cone(),
        f"{_FOLDER}/meshes/rock.obj": rock(_random(config, 0x50C4)),
    }


def terrain_of(config: ForestConfig) -> Terrain:
    """The ground that `forest` builds."""
    random = _random(config, 0x411)
    return hills(random, config.length, config.width, config.relief, config.clearing)


def plants_of(config: ForestConfig) -> list[Plant]:
    """The trees and rocks that `forest` builds, trees first."""
    random = _random(config, 0xF03E57)
    ranges = [(-size / 2 + _EDGE_M, size / 2 - _EDGE_M) for size in (config.length, config.width)]
    plants: list[Plant] = []

    def add(count: int, gap: float, radii: Range, heights: Range) -> None:
        def is_free(x: float, y: float) -> bool:
            is_apart = all(math.hypot(x - plant.x, y - plant.y) >= gap for plant in plants)
            return is_apart and math.hypot(x, y) >= config.clearing

        for _ in range(count):
            place = free_place(random, ranges[0], ranges[1], is_free, _TRIES)
            if place is None:
                return
            plants.append(
                Plant(*place, float(random.uniform(*radii)), float(random.uniform(*heights)))
            )

    add(config.trees, config.spacing, (0.1, 0.22), (3.5, 7.0))
    add(config.rocks, min(_ROCK_GAP_M, config.spacing), (0.12, 0.4), (0.0, 0.0))
    return plants


def _random(config: ForestConfig, part: int) -> np.random.Generator:
    """A stream per part, so that one more tree moves no hill."""
    return np.random.default_rng([config.seed, part])


def _tree(
    model: StaticModel, name: str, plant: Plant, ground: Terrain, random: np.random.Generator
) -> None:
    """A trunk, and on it a cone (a spruce) or a ball (a broad-leaved tree)."""
    x, y, foot = plant.x, plant.y, ground.height(plant.x, plant.y)
    is_spruce = bool(random.uniform() < 0.6)
    crown = float(random.uniform(0.8, 1.25)) * plant.height / 5.0
    bare = float(random.uniform(0.2, 0.35)) * plant.height  # below the crown
    trunk = bare + (0.1 if is_spruce else 0.3 * crown) + _ROOTS_M
    center = (x, y, foot - _ROOTS_M + trunk / 2)
    model.cylinder(f"{name}_trunk", plant.radius, trunk, center, _BARK)
    if is_spruce:
        scale = (crown, crown, plant.height - bare)
        origin = (x, y, foot + bare)
        model.mesh(f"{name}_crown", f"{_URI}/meshes/cone.obj", scale, origin, _NEEDLES)
    else:
        model.sphere(f"{name}_crown", crown, (x, y, foot + bare + 0.9 * crown), _LEAVES)


def _rock(
    model: StaticModel, name: str, plant: Plant, ground: Terrain, random: np.random.Generator
) -> None:
    """Flatter than wide, and partly in the ground."""
    flat = float(random.uniform(0.6, 0.9))
    yaw = float(random.uniform(0.0, 2.0 * math.pi))
    origin = (plant.x, plant.y, ground.height(plant.x, plant.y) + 0.2 * flat * plant.radius)
    scale = (plant.radius, plant.radius, flat * plant.radius)
    model.mesh(name, f"{_URI}/meshes/rock.obj", scale, origin, _STONE, yaw=yaw)
