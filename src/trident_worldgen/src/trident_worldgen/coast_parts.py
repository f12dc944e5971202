# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What people have built on a coast: a road and a harbour."""

from __future__ import annotations

from dataclasses import dataclass

from trident_worldgen.sdf import Color, StaticModel

_ASPHALT = Color((0.2, 0.2, 0.21))
_PAINT = Color((0.9, 0.9, 0.85))
_CONCRETE = Color((0.62, 0.61, 0.58))
_BRICK = Color((0.55, 0.22, 0.15))
_STEEL = Color((0.85, 0.55, 0.1))
_WHITE = Color((0.92, 0.92, 0.9))
_RED = Color((0.75, 0.08, 0.06))
_CARGO = (Color((0.1, 0.25, 0.5)), Color((0.6, 0.15, 0.1)), Color((0.15, 0.4, 0.2)))

_THICK_M = 0.02  # of asphalt and paint, which are only seen: wheels roll on the ground
_ROAD_Y_M = 50.0
_QUAY_M = 8.0  # width of the quays and moles


@dataclass(frozen=True)
class Rectangle:
    """What something takes of the ground, sides along x and y [m].

    Attributes:
        x: of its middle.
        y: of its middle.
        length: along x.
        width: along y.
        height: of its top above the quay; the quays and moles themselves have 0.
    """

    x: float
    y: float
    length: float
    width: float
    height: float = 0.0


def walls(front_y: float) -> dict[str, Rectangle]:
    """The quay and the moles by name; the quay's face looks south from `front_y` [m]."""
    return {
        "quay": Rectangle(30.0, front_y + _QUAY_M / 2, 80.0, _QUAY_M),
        "mole_west": Rectangle(-6.0, front_y - 30.0, _QUAY_M, 60.0),
        "mole_east": Rectangle(66.0, front_y - 20.0, _QUAY_M, 40.0),
    }


def buildings(front_y: float) -> dict[str, Rectangle]:
    """What stands behind the quay and on it, by name."""
    built = {"shed": Rectangle(0.0, front_y + 15.0, 22.0, 9.0, 5.5)}
    for index in range(3):
        built[f"containers{index}"] = Rectangle(48.0 + 7.0 * index, front_y + 14.0, 6.06, 2.44, 5.2)
    built["crane_tower"] = Rectangle(66.0, front_y + 4.0, 1.6, 1.6, 12.0)
    built["lighthouse"] = Rectangle(-6.0, front_y - 56.0, 2.8, 2.8, 8.6)
    return built


def road(land: StaticModel, level: float, length: float) -> None:
    """Add a road along y = 50 m with a dashed line, and its branch to the quay.

    Args:
        land: gets it.
        level: of the ground below it [m].
        length: of the road [m].
    """
    top, end = level + _THICK_M / 2, length / 2
    land.box("road", (length, 7.0, _THICK_M), (0.0, _ROAD_Y_M, top), _ASPHALT, solid=False)
    land.box("branch", (6.0, 13.5, _THICK_M), (30.0, 39.75, top), _ASPHALT, solid=False)
    for index in range(int(length // 8.0)):
        center = (7.0 - end + 8.0 * index, _ROAD_Y_M, top + _THICK_M)
        land.box(f"dash{index}", (3.0, 0.15, _THICK_M), center, _PAINT, solid=False)
    last = int(end // 30.0) * 30
    for index, x in enumerate(range(-last, last + 1, 30)):
        post = (float(x), _ROAD_Y_M + 5.0, level + 0.5)
        land.box(f"post{index}", (0.15, 0.15, 1.0), post, _PAINT)


def harbour(quays: StaticModel, level: float, bed: float, front_y: float) -> None:
    """Add a quay, two moles, and what stands on them.

    Args:
        quays: gets it.
        level: of their tops [m].
        bed: the basin's bottom [m].
        front_y: the quay's face looks south from here [m].
    """
    height = level - bed + 1.0
    middle = level - height / 2
    for name, wall in walls(front_y).items():
        size = (wall.length, wall.width, height)
        quays.box(name, size, (wall.x, wall.y, middle), _CONCRETE)
    for index in range(7):
        bollard = (3.0 + 9.0 * index, front_y + 0.6, level + 0.25)
        quays.cylinder(f"bollard{index}", 0.2, 0.5, bollard, _STEEL)
    _buildings(quays, level, front_y)
    light = (-6.0, front_y - 56.0)
    quays.cylinder("lighthouse", 1.4, 7.0, (*light, level + 3.5), _WHITE)
    quays.cylinder("lantern", 1.0, 1.6, (*light, level + 7.8), _RED)


def _buildings(quays: StaticModel, level: float, front_y: float) -> None:
    """A shed, stacked containers and a crane."""
    quays.box("shed", (22.0, 9.0, 5.5), (0.0, front_y + 15.0, level + 2.75), _BRICK)
    for index in range(6):
        x, storey = 48.0 + 7.0 * (index % 3), index // 3
        center = (x, front_y + 14.0, level + 1.3 + 2.6 * storey)
        quays.box(f"container{index}", (6.06, 2.44, 2.59), center, _CARGO[(index + storey) % 3])
    foot = (66.0, front_y + 4.0)
    quays.box("crane_tower", (1.6, 1.6, 12.0), (*foot, level + 6.0), _STEEL)
    quays.box("crane_arm", (1.0, 18.0, 1.0), (foot[0], foot[1] - 5.0, level + 12.5), _STEEL)
