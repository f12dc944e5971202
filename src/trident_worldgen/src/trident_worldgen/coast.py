# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A coast: hills in the north, the sea in the south, and a harbour and a road between them."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from trident_worldgen.buoys import GREEN, RED, SKY, YELLOW, Buoy, place_text, sea_text
from trident_worldgen.checks import require, require_count, require_seed
from trident_worldgen.coast_cells import Area, Post
from trident_worldgen.coast_parts import harbour, road
from trident_worldgen.coast_search import SearchSite, search_site
from trident_worldgen.noise import Field, grain
from trident_worldgen.parts import model_config, rock_model
from trident_worldgen.placing import free_place
from trident_worldgen.sdf import Color, Files, StaticModel, world_text
from trident_worldgen.shapes import cone, rock
from trident_worldgen.terrain import Terrain, terrain_of

LAND_M = 1.5
"""Height of the road and of the quays above the still water."""
BED_M = -10.0
"""The sea's bottom off the shore."""
BASIN_M = -5.0
"""That of the harbour."""
QUAY_Y_M = 25.0
"""The harbour lies south of this line."""

_FOLDER = "models/coast_parts"
_URI = "model://coast_parts"
_SAMPLES = 129
_GROUND = Color((0.46, 0.45, 0.3))
_BARK = Color((0.36, 0.25, 0.16))
_NEEDLES = Color((0.1, 0.3, 0.16))
_STONE = Color((0.45, 0.44, 0.42))
_ROAD_END_M = 30.0  # of the length, that the road does not reach
_OCTAVES = ((4, 1.0), (9, 0.4), (23, 0.1))
_TRIES = 60
_BUOY_M = 2.5  # in which a buoy swings where boats search
_EDGE_M = 4.0
_RELIEF_M = 14.0
_SEARCH_RELIEF_M = 4.5
"""Of hills that a ground robot climbs: with the road's height 6 m above the still water."""


@dataclass(frozen=True)
class CoastConfig:
    """What a coast has.

    Attributes:
        seed: decides the hills, the bays, and what grows, stands and lies where.
        length: along x [m].
        width: along y [m].
        relief: of the hills over the road [m]; None: 14, or 4.5 where something is searched for.
        trees: how many; fewer where there is no room.
        rocks: how many, on land and off the shore.
        covers: roofs and groves of 18 m x 18 m, below which only the ground sees.
        casualties: how many people lie in the open, below covers, and float in the water.
    """

    seed: int = 1
    length: float = 300.0
    width: float = 300.0
    relief: float | None = None
    trees: int = 90
    rocks: int = 36
    covers: int = 0
    casualties: int = 0

    @property
    def is_searched(self) -> bool:
        """Whether there is something to be found."""
        return self.covers > 0 or self.casualties > 0

    @property
    def hills(self) -> float:
        """Relief over the road [m]."""
        if self.relief is not None:
            return self.relief
        return _SEARCH_RELIEF_M if self.is_searched else _RELIEF_M

    def validate(self) -> None:
        """Raises Error naming the field, its value and what is legal."""
        require_seed(self.seed)
        require("length", self.length, 300.0, 800.0)
        require("width", self.width, 300.0, 800.0)
        require("relief", self.hills, 0.0, 30.0)
        require_count("trees", self.trees, 2000)
        require_count("rocks", self.rocks, 1000)
        require_count("covers", self.covers, 100)
        require_count("casualties", self.casualties, 200)


def coast(config: CoastConfig | None = None) -> Files:
    """`coast.world`, its terrain and its meshes.

    Raises:
        Error: an illegal configuration, or no room for what is asked.
    """
    config = config or CoastConfig()
    config.validate()
    ground = coast_ground(config)
    site = _site(config, ground)
    land = StaticModel("coast")
    size = (config.length, config.width, ground.relief)
    land.heightmap("terrain", f"{_URI}/terrain.png", size, (0.0, 0.0, ground.lowest), _GROUND)
    site.place_casualties(_grow(land, config, ground, site))
    road(land, LAND_M, config.length - _ROAD_END_M)
    quays = StaticModel("harbour")
    harbour(quays, LAND_M, BASIN_M, QUAY_Y_M)
    swing = _BUOY_M if config.is_searched else None
    more = "".join(replace(buoy, swing=swing).text() for buoy in fairway(ground))
    more += sea_text("search_coast" if config.is_searched else "coast")
    more += place_text(63.4389, 10.399)
    comment = (
        f"A coast of {config.length:g} m x {config.width:g} m: hills, a road, a harbour, and the "
        f"sea in the south. Made by ./trident worldgen coast, seed {config.seed}"
    )
    return site.record("coast") | {
        "coast.world": world_text(
            comment,
            [land, quays, *site.models()],
            name="coast",
            ground=False,
            step_s=0.004,
            gravity=9.81,
            sky=SKY,
            more=more,
        ),
        f"{_FOLDER}/model.config": model_config("coast_parts", "Terrain and meshes of the coast."),
        f"{_FOLDER}/model.sdf": rock_model("coast_parts", "coast.world"),
        f"{_FOLDER}/terrain.png": ground.picture(),
        f"{_FOLDER}/meshes/cone.obj": cone(),
        f"{_FOLDER}/meshes/rock.obj": rock(_random(config, 0x50C4)),
    }


def coast_ground(config: CoastConfig) -> Terrain:
    """The ground that `coast` builds, above and below the water."""
    x = np.linspace(-config.length / 2, config.length / 2, _SAMPLES)[None, :]
    y = np.linspace(config.width / 2, -config.width / 2, _SAMPLES)[:, None]
    random = _random(config, 0xC0A57)
    inland = y - _shore_y(config, x)  # m north of the shore
    noise = sum(share * grain(random, _SAMPLES, cells) for cells, share in _OCTAVES)
    assert isinstance(noise, np.ndarray)
    noise = (noise - noise.min()) / max(float(np.ptp(noise)), 1e-9)
    hills = LAND_M + config.hills * noise * _smooth((inland - 45.0) / 60.0)
    beach = 0.08 * inland
    ground = np.where(inland > 0.0, np.minimum(beach, LAND_M) + hills - LAND_M, 0.0)
    bed = np.maximum(0.11 * inland, BED_M + 0.8 * noise)
    ground = np.where(inland > 0.0, ground, bed)
    ground = _levelled(ground, LAND_M, _road_distance(config, x, y), 5.0, 16.0)
    # The yard behind the quays, then the basin, whose edges the quays' walls hide.
    ground = _levelled(ground, LAND_M, _outside(x, y, (-20.0, 80.0), (29.0, 62.0)), 0.0, 12.0)
    ground = _levelled(ground, BASIN_M, _outside(x, y, (-2.0, 62.0), (-40.0, 26.0)), 0.0, 6.0)
    return terrain_of(ground, config.length, config.width)


def fairway(ground: Terrain) -> list[Buoy]:
    """The buoys of the harbour's approach, red to port when coming in, and two of a course."""
    places = [
        ("buoy_red_1", 0.0, -45.0, RED),
        ("buoy_green_1", 60.0, -45.0, GREEN),
        ("buoy_red_2", 0.0, -85.0, RED),
        ("buoy_green_2", 60.0, -85.0, GREEN),
        ("buoy_west", -60.0, -90.0, YELLOW),
        ("buoy_east", 110.0, -90.0, YELLOW),
    ]
    return [Buoy(name, x, y, round(-ground.height(x, y), 2), color) for name, x, y, color in places]


def _shore_y(config: CoastConfig, x: Field) -> Field:
    """Where the land begins: bays and capes, straight about the harbour [m]."""
    random = _random(config, 0x54023)
    bays = np.zeros_like(x)
    for waves, height in ((1.5, 9.0), (3.0, 5.0), (7.0, 1.5)):
        phase = float(random.uniform(0.0, 2.0 * math.pi))
        bays += height * np.sin(2.0 * math.pi * waves * x / config.length + phase)
    away = _smooth((np.abs(x - 30.0) - 50.0) / 40.0)
    shore: Field = 16.0 + away * bays
    return shore


def _road_distance(config: CoastConfig, x: Field, y: Field) -> Field:
    """To the middle of the road along y = 50 m [m]."""
    end = (config.length - _ROAD_END_M) / 2
    return np.asarray(np.hypot(np.maximum(np.abs(x) - end, 0.0), y - 50.0))


def _outside(
    x: Field, y: Field, x_range: tuple[float, float], y_range: tuple[float, float]
) -> Field:
    """Distance to a rectangle [m]; 0 within."""
    across = np.maximum(np.maximum(x_range[0] - x, x - x_range[1]), 0.0)
    along = np.maximum(np.maximum(y_range[0] - y, y - y_range[1]), 0.0)
    return np.asarray(np.hypot(across, along))


def _levelled(ground: Field, level: float, distance: Field, near: float, far: float) -> Field:
    """The ground brought to a level up to `near`, itself again from `far` on [m]."""
    share = _smooth((distance - near) / (far - near))
    return np.asarray(level + share * (ground - level))


def _smooth(share: Field) -> Field:
    """0 up to 0, 1 from 1 on, without a kink between."""
    share = np.clip(share, 0.0, 1.0)
    return np.asarray(share * share * (3.0 - 2.0 * share))


def _site(config: CoastConfig, ground: Terrain) -> SearchSite:
    """What is to be found on this ground; nothing, unless it is asked for."""
    floats = [Post(buoy.x, buoy.y, _BUOY_M) for buoy in fairway(ground)]
    area = Area(ground, QUAY_Y_M, LAND_M, floats if config.is_searched else [])
    return search_site(area, config.seed, config.covers, config.casualties)


def _grow(land: StaticModel, config: CoastConfig, ground: Terrain, site: SearchSite) -> list[Post]:
    """Spruces on the hills; rocks there and off the shore. Returns what they take of the ground."""
    random = _random(config, 0x72EE)
    end, edge = config.length / 2 - _EDGE_M, config.width / 2 - _EDGE_M
    taken: list[tuple[float, float]] = []
    posts = []

    def is_free(x: float, y: float) -> bool:
        return not site.is_covered(x, y) and all(math.hypot(x - a, y - b) > 4.0 for a, b in taken)

    for index in range(config.trees):
        place = free_place(random, (-end, end), (70.0, edge), is_free, _TRIES)
        if place is None:
            break
        taken.append(place)
        height = float(random.uniform(5.0, 9.0))
        _spruce(land, f"tree{index}", (*place, ground.height(*place)), height)
        posts.append(Post(*place, 0.03 * height))
    for index in range(config.rocks):
        x, y = float(random.uniform(-end, -35.0)), float(random.uniform(-25.0, 40.0))
        radius, yaw = float(random.uniform(0.4, 1.8)), float(random.uniform(0.0, 6.28))
        scale, foot = (radius, radius, 0.8 * radius), ground.height(x, y)
        if not _is_off_the_road(y, radius) or site.is_covered(x, y):
            continue
        land.mesh(f"rock{index}", f"{_URI}/meshes/rock.obj", scale, (x, y, foot), _STONE, yaw=yaw)
        posts.append(Post(x, y, 1.1 * radius))
    return posts


def _spruce(land: StaticModel, name: str, foot: tuple[float, float, float], height: float) -> None:
    x, y, z = foot
    radius, trunk = 0.03 * height, 0.3 * height + 0.3
    land.cylinder(f"{name}_trunk", radius, trunk, (x, y, z - 0.3 + trunk / 2), _BARK)
    scale = (0.2 * height, 0.2 * height, 0.72 * height)
    crown = (x, y, z + 0.28 * height)
    land.mesh(f"{name}_crown", f"{_URI}/meshes/cone.obj", scale, crown, _NEEDLES)


def _is_off_the_road(y: float, radius: float) -> bool:
    return abs(y - 50.0) > 8.0 + radius


def _random(config: CoastConfig, part: int) -> np.random.Generator:
    """A stream per part, so that one more tree moves no hill."""
    return np.random.default_rng([config.seed, part])
