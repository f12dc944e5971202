# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The true occupancy map of a terrain: obstacles at heights above the ground that they stand on."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from trident_sim._core import Error
from trident_sim.occupancy import (
    FREE,
    OCCUPIED,
    UNKNOWN,
    Cells,
    MapConfig,
    OccupancyMap,
    paired,
    reachable,
)
from trident_sim.world import World

_TOP_M = 500.0  # where rays that point down begin
_BEYOND_M = 1e-4  # a surface that was hit
_COARSE_M = 1.0
_RAYS_AT_ONCE = 1_000_000
_MAX_CELLS = 20_000_000
_MAX_SURFACES = 10_000

_MIN_SHARE = 0.2

_Ints = npt.NDArray[np.int64]
_Floats = npt.NDArray[np.float64]


@dataclass(frozen=True)
class _Columns:
    """What lies above and below each other in columns; a lone surface is its own other end.

    Attributes:
        cell: number of the column, shape (n,).
        shape: number of the shape, shape (n,).
        top: upper end [m], shape (n,).
        bottom: lower end [m], shape (n,).
    """

    cell: _Ints
    shape: _Ints
    top: _Floats
    bottom: _Floats


def map_above_ground(world: World, config: MapConfig | None = None) -> OccupancyMap:
    """What a perfect mapper would find whose lidar is carried at some heights above the ground.

    The ground are surfaces without a second one below: a heightmap, a plane. A cell is OCCUPIED
    when a closed shape (a trunk, a rock) is at one of the heights over its ground, FREE when it can
    be reached from the start over ground, else UNKNOWN. Slopes are no obstacles.

    Args:
        world: is not changed.
        config: what to look at; there is no margin.

    Raises:
        Error: an illegal configuration, no ground within reach or at the start, a start within an
            obstacle, or a map of more than 2 * 10^7 cells.
    """
    config = config or MapConfig()
    config.validate()
    x, y = _grid(world, config)
    columns = _columns(world, np.tile(x, len(y)), np.repeat(y, len(x)))
    cells = _classified(columns, len(x) * len(y), config).reshape(len(y), len(x))
    origin = (x[0] - config.resolution / 2, y[0] - config.resolution / 2)
    cells[(cells == FREE) & ~reachable(cells != FREE, origin, config)] = UNKNOWN
    return OccupancyMap(cells, config.resolution, origin)


def _grid(world: World, config: MapConfig) -> tuple[_Floats, _Floats]:
    """Middles of the columns and rows of cells that cover the ground within reach [m]."""
    pitch = max(min(_COARSE_M, config.reach / 4), config.resolution)
    steps = np.arange(-math.ceil(config.reach / pitch), math.ceil(config.reach / pitch) + 1) * pitch
    x, y = (np.tile(steps, len(steps)), np.repeat(steps, len(steps)))
    x, y = x + config.start[0], y + config.start[1]
    hit = _cast_down(world, x, y, np.full(len(x), _TOP_M))[0] >= 0
    if not hit.any():
        raise Error(f"no ground within {config.reach:g} m of the start")
    sides = []
    for places, start in ((x, config.start[0]), (y, config.start[1])):
        low = max(places[hit].min() - pitch, start - config.reach)
        high = min(places[hit].max() + pitch, start + config.reach)
        first = math.floor(low / config.resolution)
        count = math.ceil(high / config.resolution) - first
        sides.append((first + 0.5 + np.arange(count)) * config.resolution)
    if len(sides[0]) * len(sides[1]) > _MAX_CELLS:
        raise Error(
            f"resolution: {config.resolution:g} m makes {len(sides[0])} x {len(sides[1])} cells, "
            "legal: up to 2e7; a smaller reach leaves out what is far away"
        )
    return sides[0], sides[1]


def _classified(columns: _Columns, count: int, config: MapConfig) -> Cells:
    """OCCUPIED, FREE (reachable or not) or, without ground, UNKNOWN, shape (count,)."""
    is_lone = columns.top <= columns.bottom
    is_ground = is_lone & _are_ground(columns.shape, is_lone)[columns.shape]
    ground = np.full(count, -np.inf)
    np.maximum.at(ground, columns.cell[is_ground], columns.top[is_ground])
    # Of a plane and what stands on it a ray that comes from above hits one at their common place.
    lowest = np.full(count, np.inf)
    np.minimum.at(lowest, columns.cell, columns.bottom)
    ground = np.where(np.isfinite(ground), ground, lowest)
    cell, top = columns.cell[~is_ground], columns.top[~is_ground]
    bottom = np.where(is_lone, ground[columns.cell], columns.bottom)[~is_ground]
    cells = np.where(np.isfinite(ground), FREE, UNKNOWN).astype(np.int8)
    for height in config.heights:
        wanted = ground[cell] + height
        cells[cell[(bottom <= wanted) & (wanted <= top)]] = OCCUPIED
    return cells


def _are_ground(shape: _Ints, is_lone: npt.NDArray[np.bool_]) -> npt.NDArray[np.bool_]:
    """Whether a shape, by its number, is ground: open, and not much smaller than the largest."""
    lone = np.bincount(shape[is_lone], minlength=int(shape.max()) + 1)
    hit = np.bincount(shape, minlength=len(lone))
    return (lone > _MIN_SHARE * lone.max()) & (lone > 0.5 * hit)


def _columns(world: World, x: _Floats, y: _Floats) -> _Columns:
    """What rays that point down hit at places [m], shape (N,) each."""
    parts = []
    for begin in range(0, len(x), _RAYS_AT_ONCE):
        some = slice(begin, begin + _RAYS_AT_ONCE)
        parts.append(_columns_at_once(world, x[some], y[some], begin))
    return _Columns(*(np.concatenate(values) for values in zip(*parts, strict=True)))


def _columns_at_once(
    world: World, x: _Floats, y: _Floats, first: int
) -> tuple[_Ints, _Ints, _Floats, _Floats]:
    """The fields of _Columns; the first place is column `first`."""
    line, place = np.arange(len(x)), np.full(len(x), _TOP_M)
    lines, shapes, places = [], [], []
    for _ in range(_MAX_SURFACES):
        shape, distance = _cast_down(world, x[line], y[line], place)
        hit = shape >= 0
        line, place = line[hit], place[hit] - distance[hit]
        lines.append(line)
        shapes.append(shape[hit])
        places.append(-place)  # downwards, as spans are counted
        if not line.size:
            break
        place = place - _BEYOND_M
    cell, shape, begin, end = paired(*(np.concatenate(v) for v in (lines, shapes, places)))
    return cell + first, shape, -begin, -end


def _cast_down(world: World, x: _Floats, y: _Floats, z: _Floats) -> tuple[_Ints, _Floats]:
    """Number of the shape that is hit first (-1: none), and how far down [m], shape (N,) each."""
    down = np.broadcast_to(np.array([0.0, 0.0, -1.0]), (len(x), 3))
    hits = world.cast_rays(np.stack([x, y, z], axis=1), down)
    return np.asarray(hits.shape, np.int64), np.asarray(hits.distance, np.float64)
