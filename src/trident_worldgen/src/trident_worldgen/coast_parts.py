# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What people have built on a coast: a road and a harbour."""

from __future__ import annotations

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


def road(land: StaticModel, level: float) -> None:
    """Add a road along y = 50 m with a dashed line, and its branch to the quay.

    Args:
        land: gets it.
        level: of the ground below it [m].
    """
    top = level + _THICK_M / 2
    land.box("road", (270.0, 7.0, _THICK_M), (0.0, _ROAD_Y_M, top), _ASPHALT, solid=False)
    land.box("branch", (6.0, 13.5, _THICK_M), (30.0, 39.75, top), _ASPHALT, solid=False)
    for index in range(33):
        center = (-128.0 + 8.0 * index, _ROAD_Y_M, top + _THICK_M)
        land.box(f"dash{index}", (3.0, 0.15, _THICK_M), center, _PAINT, solid=False)
    for index, x in enumerate(range(-120, 121, 30)):
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
    quay_y = front_y + _QUAY_M / 2
    quays.box("quay", (80.0, _QUAY_M, height), (30.0, quay_y, middle), _CONCRETE)
    quays.box("mole_west", (_QUAY_M, 60.0, height), (-6.0, front_y - 30.0, middle), _CONCRETE)
    quays.box("mole_east", (_QUAY_M, 40.0, height), (66.0, front_y - 20.0, middle), _CONCRETE)
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
