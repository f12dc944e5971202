# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A hall for cameras: floor, walls, pillars and crates are covered with pictures."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from PIL import Image

from trident_worldgen.checks import require, require_count, require_seed
from trident_worldgen.noise import grain, png
from trident_worldgen.parts import model_config
from trident_worldgen.placing import free_place
from trident_worldgen.sdf import Files, Picture, StaticModel, world_text

_FOLDER = "models/hall_pictures/materials/textures"
_URI = "model://hall_pictures/materials/textures"
_TILE_M = 5.0
_POSTER_M = 1.6
_PIXELS = 256
_POSTER_PIXELS = 160
_CRATE_M = 0.6
_PILLAR_M = 0.5
_FREE_M = 2.0  # about the middle of the hall, where robots begin
_TRIES = 50

Pixels = npt.NDArray[np.uint8]


@dataclass(frozen=True)
class HallConfig:
    """Sizes of the hall [m].

    Attributes:
        seed: decides the pictures and where crates stand.
        length: along x, within the walls.
        width: along y, within the walls.
        height: of the walls; there is no roof.
        crates: how many.
    """

    seed: int = 1
    length: float = 20.0
    width: float = 15.0
    height: float = 4.0
    crates: int = 8

    def validate(self) -> None:
        """Raises Error naming the field, its value and what is legal."""
        require_seed(self.seed)
        require("length", self.length, 10.0, 100.0)
        require("width", self.width, 10.0, 100.0)
        require("height", self.height, 2.5, 20.0)
        require_count("crates", self.crates, 100)


def hall(config: HallConfig | None = None) -> Files:
    """`hall.world` and the pictures that it shows.

    Raises:
        Error: an illegal configuration.
    """
    config = config or HallConfig()
    config.validate()
    random = np.random.default_rng([config.seed, 0x4A11])
    model = StaticModel("hall")
    files: Files = {
        "models/hall_pictures/model.config": model_config(
            "hall_pictures", "The pictures of the hall."
        ),
        "models/hall_pictures/model.sdf": _MODEL_SDF,
        f"{_FOLDER}/floor.png": _png(_tiles(random), 32),
        f"{_FOLDER}/wall.png": _png(_plaster(random), 16),
        f"{_FOLDER}/crate.png": _png(_planks(random), 16),
        f"{_FOLDER}/pillar.png": _png(_bricks(random), 16),
    }
    _floor(model, config)
    _walls(model, config)
    for index, place in enumerate(_poster_places(config)):
        name = f"poster{index}"
        files[f"{_FOLDER}/{name}.png"] = _png(_poster(random), 12)
        _poster_box(model, name, place)
    _pillars(model, config)
    _crates(model, config, random)
    comment = (
        f"A hall of {config.length:g} m x {config.width:g} m, covered with pictures for cameras. "
        f"Made by ./trident worldgen hall, seed {config.seed}"
    )
    files["hall.world"] = world_text(comment, [model])
    return files


def _picture(name: str, color: tuple[float, float, float]) -> Picture:
    return Picture(f"{_URI}/{name}.png", color)


def _floor(model: StaticModel, config: HallConfig) -> None:
    """Squares of one picture, only seen: bodies stand on the ground plane."""
    look = _picture("floor", (0.6, 0.58, 0.55))
    columns, rows = (math.ceil(size / _TILE_M) for size in (config.length, config.width))
    size = (config.length / columns, config.width / rows, 0.004)
    for i in range(columns):
        for j in range(rows):
            center = (
                -config.length / 2 + (i + 0.5) * size[0],
                -config.width / 2 + (j + 0.5) * size[1],
                0.0,
            )
            model.box(f"floor_{i}_{j}", size, center, look, solid=False)


def _walls(model: StaticModel, config: HallConfig) -> None:
    look = _picture("wall", (0.8, 0.78, 0.72))
    x, y, z, t = config.length / 2, config.width / 2, config.height, 0.2
    for name, sign in (("north", 1), ("south", -1)):
        size = (config.length + 2 * t, t, z)
        model.box(name, size, (0.0, sign * (y + t / 2), z / 2), look)
    for name, sign in (("east", 1), ("west", -1)):
        model.box(name, (t, config.width, z), (sign * (x + t / 2), 0.0, z / 2), look)


@dataclass(frozen=True)
class _Place:
    x: float
    y: float
    along_x: bool


def _poster_places(config: HallConfig) -> list[_Place]:
    """Along all four walls, 1 cm before them."""
    x, y = config.length / 2 - 0.01, config.width / 2 - 0.01
    places = []
    for sign in (1, -1):
        for along in _spread(config.length):
            places.append(_Place(along, sign * y, True))
        for along in _spread(config.width):
            places.append(_Place(sign * x, along, False))
    return places


def _spread(length: float) -> list[float]:
    count = max(2, int(length / 4.0))
    return [(-0.5 + (index + 0.5) / count) * length for index in range(count)]


def _poster_box(model: StaticModel, name: str, place: _Place) -> None:
    thin = 0.02
    size = (_POSTER_M, thin, _POSTER_M) if place.along_x else (thin, _POSTER_M, _POSTER_M)
    look = _picture(name, (0.5, 0.5, 0.5))
    model.box(name, size, (place.x, place.y, 1.5), look, solid=False)


def _pillars(model: StaticModel, config: HallConfig) -> None:
    look = _picture("pillar", (0.55, 0.3, 0.24))
    size = (_PILLAR_M, _PILLAR_M, config.height)
    for i, sx in enumerate((-1, 1)):
        for j, sy in enumerate((-1, 1)):
            center = (sx * config.length / 4, sy * config.width / 4, config.height / 2)
            model.box(f"pillar_{i}_{j}", size, center, look)


def _crates(model: StaticModel, config: HallConfig, random: np.random.Generator) -> None:
    """Where there is room; some stand on another."""
    look = _picture("crate", (0.55, 0.4, 0.25))
    taken = [(sx * config.length / 4, sy * config.width / 4) for sx in (-1, 1) for sy in (-1, 1)]
    x_range, y_range = ((-size / 2 + 0.7, size / 2 - 0.7) for size in (config.length, config.width))

    def is_free(x: float, y: float) -> bool:
        is_apart = all(math.hypot(x - u, y - v) > 1.8 for u, v in taken)
        return is_apart and math.hypot(x, y) > _FREE_M

    for index in range(config.crates):
        place = free_place(random, x_range, y_range, is_free, _TRIES)
        if place is None:
            continue
        taken.append(place)
        _stack(model, f"crate{index}", place, look, random)


def _stack(
    model: StaticModel,
    name: str,
    place: tuple[float, float],
    look: Picture,
    random: np.random.Generator,
) -> None:
    """One crate or two, the upper one turned a little."""
    yaw = float(random.uniform(0.0, math.pi / 2))
    for level in range(int(random.integers(1, 3))):
        size = (_CRATE_M, _CRATE_M, _CRATE_M)
        center = (*place, (level + 0.5) * _CRATE_M)
        model.box(f"{name}_{level}", size, center, look, yaw=yaw + 0.3 * level)


def _png(pixels: Pixels, colors: int) -> bytes:
    """A small file: few colors."""
    image = Image.fromarray(pixels, "RGB").quantize(colors, dither=Image.Dither.NONE)
    return png(image.convert("RGB"))


def _tinted(shade: npt.NDArray[np.float64], color: tuple[float, float, float]) -> Pixels:
    """Shades [0, 1], shape (h, w), of one color."""
    rgb = shade[:, :, None] * np.asarray(color)
    return np.round(255.0 * rgb.clip(0.0, 1.0)).astype(np.uint8)


def _tiles(random: np.random.Generator) -> Pixels:
    """Ten by ten floor tiles, each of its own shade, with joints."""
    n = 10
    index = np.arange(_PIXELS) * n // _PIXELS
    shade = random.uniform(0.65, 1.0, (n, n))[index][:, index]
    shade = shade * (0.85 + 0.15 * grain(random, _PIXELS, 16))
    edge = np.diff(index, append=n) != 0
    shade[edge, :] = 0.35
    shade[:, edge] = 0.35
    return _tinted(shade, (0.8, 0.76, 0.7))


def _plaster(random: np.random.Generator) -> Pixels:
    shade = 0.8 + 0.12 * grain(random, _PIXELS, 8) + 0.08 * grain(random, _PIXELS, 32)
    shade[-_PIXELS // 6 :] *= 0.6  # a painted base
    return _tinted(shade, (0.95, 0.92, 0.82))


def _planks(random: np.random.Generator) -> Pixels:
    """Six boards across, with a frame and a diagonal."""
    index = np.arange(_PIXELS) * 6 // _PIXELS
    shade = np.repeat(random.uniform(0.6, 0.9, 6)[index][:, None], _PIXELS, axis=1)
    shade = shade * (0.8 + 0.2 * grain(random, _PIXELS, 24))
    y, x = np.mgrid[:_PIXELS, :_PIXELS] / _PIXELS
    frame = (np.minimum.reduce([x, y, 1 - x, 1 - y]) < 0.08) | (np.abs(x - y) < 0.06)
    shade[frame] = 0.45 + 0.1 * grain(random, _PIXELS, 24)[frame]
    return _tinted(shade, (0.95, 0.68, 0.4))


def _bricks(random: np.random.Generator) -> Pixels:
    """Courses of bricks, every other one shifted by half a brick."""
    y, x = np.mgrid[:_PIXELS, :_PIXELS]
    course = y * 32 // _PIXELS
    along = x * 4.0 / _PIXELS + 0.5 * (course % 2)
    shades = random.uniform(0.6, 1.0, (32, 5))
    shade = shades[course, along.astype(int)]
    mortar = (y * 32 % _PIXELS < 32) | (along % 1.0 < 0.06)
    pixels = _tinted(shade, (0.75, 0.35, 0.26))
    pixels[mortar] = 180
    return pixels


def _poster(random: np.random.Generator) -> Pixels:
    """Discs and bars in strong colors on a ground of its own: with distinct corners."""
    n = _POSTER_PIXELS
    y, x = np.mgrid[:n, :n]
    pixels = np.empty((n, n, 3), np.uint8)
    pixels[:] = random.integers(120, 256, 3)
    for _ in range(14):
        color = random.integers(0, 256, 3)
        u, v = random.uniform(0.0, n, 2)
        if random.integers(0, 2):
            inside = (x - u) ** 2 + (y - v) ** 2 < random.uniform(0.04, 0.16) ** 2 * n**2
        else:
            angle = random.uniform(0.0, math.pi)
            a = (x - u) * math.cos(angle) + (y - v) * math.sin(angle)
            b = (y - v) * math.cos(angle) - (x - u) * math.sin(angle)
            inside = (np.abs(a) < 0.25 * n) & (np.abs(b) < random.uniform(0.02, 0.07) * n)
        pixels[inside] = color
    # An arrow up in the upper left corner: pictures can be upside down, this one shows it.
    up = (y > 8) & (y < 30) & (np.abs(x - 20) < (y - 8) * 0.6)
    pixels[up] = (0, 0, 0)
    return pixels


_MODEL_SDF = """<?xml version="1.0"?>
<!-- SPDX-FileCopyrightText: 2026 The Trident authors -->
<!-- SPDX-License-Identifier: Apache-2.0 -->
<!-- Holds the pictures of hall.world; a crate of its own. -->
<sdf version="1.6">
  <model name="hall_pictures">
    <static>true</static>
    <link name="link">
      <collision name="crate">
        <pose>0 0 0.3 0 0 0</pose>
        <geometry><box><size>0.6 0.6 0.6</size></box></geometry>
      </collision>
      <visual name="crate_visual">
        <pose>0 0 0.3 0 0 0</pose>
        <geometry><box><size>0.6 0.6 0.6</size></box></geometry>
        <material>
          <diffuse>0.55 0.4 0.25 1</diffuse>
          <pbr><metal><albedo_map>materials/textures/crate.png</albedo_map></metal></pbr>
        </material>
      </visual>
    </link>
  </model>
</sdf>
"""
