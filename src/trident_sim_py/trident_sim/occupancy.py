# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The true occupancy map of a world, as map_server's files."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt
from scipy import ndimage

from trident_sim._core import Error
from trident_sim.world import World

FREE, OCCUPIED, UNKNOWN = 0, 100, -1
"""Cell values of nav_msgs/OccupancyGrid."""

_PIXEL = {FREE: 254, OCCUPIED: 0, UNKNOWN: 205}  # what map_saver writes
_ROWS_PER_CELL = 2
_BEYOND_M = 1e-4  # a surface that was hit; Embree's floats resolve 8e-6 m at 100 m
_SAME_M = 1e-6  # places of one surface
_MAX_SURFACES = 10_000
_MAX_CELLS = 100_000_000

Cells = npt.NDArray[np.int8]
_Floats = npt.NDArray[np.float64]
_Ints = npt.NDArray[np.int64]


@dataclass(frozen=True)
class OccupancyMap:
    """A grid in the plane z = 0 of the world frame.

    Attributes:
        cells: FREE, OCCUPIED or UNKNOWN, shape (rows, columns); row 0 is at the smallest y.
        resolution: side of a cell [m].
        origin: x, y of the outer corner of cell (0, 0) [m, world].
    """

    cells: Cells
    resolution: float
    origin: tuple[float, float]

    def at(self, x: float, y: float) -> int:
        """Value of the cell at a place [m, world]; UNKNOWN outside of the grid."""
        column = math.floor((x - self.origin[0]) / self.resolution)
        row = math.floor((y - self.origin[1]) / self.resolution)
        rows, columns = self.cells.shape
        inside = 0 <= row < rows and 0 <= column < columns
        return int(self.cells[row, column]) if inside else UNKNOWN

    def save(self, path: Path) -> None:
        """Write `path` (PGM) and the YAML file next to it, as map_server reads them.

        Args:
            path: ends in `.pgm`.

        Raises:
            Error: another suffix, or a file that cannot be written.
        """
        if path.suffix != ".pgm":
            raise Error(f"{path}: suffix is '{path.suffix}', legal: .pgm")
        pixels = np.empty(self.cells.shape, np.uint8)
        for value, gray in _PIXEL.items():
            pixels[self.cells == value] = gray
        rows, columns = pixels.shape
        x, y = self.origin
        text = (
            f"image: {path.name}\nresolution: {self.resolution:.10g}\n"
            f"origin: [{x:.10g}, {y:.10g}, 0.0]\n"
            "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
        )
        try:
            # A picture begins at its top, a map at its bottom.
            path.write_bytes(f"P5\n{columns} {rows}\n255\n".encode() + pixels[::-1].tobytes())
            path.with_suffix(".yaml").write_text(text, encoding="utf-8")
        except OSError as error:
            raise Error(f"{path}: cannot be written: {error.strerror}") from error


def _check_finite(field: str, values: Sequence[float]) -> None:
    for value in values:
        if not math.isfinite(value):
            raise Error(f"{field}: {value:g} m, legal: finite")


@dataclass(frozen=True)
class MapConfig:
    """What of a world becomes a map.

    Attributes:
        resolution: side of a cell [m].
        heights: above z = 0 at which obstacles are looked for [m].
        start: a free place, x, y [m, world]; what cannot be reached from it is not free.
        reach: half the side of the square about the start that is looked at [m].
        margin: kept around the outermost obstacles [m].
    """

    resolution: float = 0.05
    heights: Sequence[float] = (0.2,)
    start: tuple[float, float] = (0.0, 0.0)
    reach: float = 100.0
    margin: float = 0.5

    def validate(self) -> None:
        """Raises Error naming the field, its value and what is legal."""
        if not 1e-3 <= self.resolution <= 10.0:
            raise Error(f"resolution: {self.resolution:g} m, legal: 0.001 to 10 m")
        if not self.heights:
            raise Error("heights: none, legal: at least one")
        _check_finite("heights", self.heights)
        _check_finite("start", self.start)
        if not self.resolution <= self.reach < math.inf:
            raise Error(f"reach: {self.reach:g} m, legal: {self.resolution:g} m or more")
        if not 0.0 <= self.margin < math.inf:
            raise Error(f"margin: {self.margin:g} m, legal: 0 or more")


@dataclass(frozen=True)
class _Spans:
    """Where lines along one axis run within a shape, from `begin` to `end` along it [m]."""

    line: _Floats  # place of the line across its axis [m]
    begin: _Floats
    end: _Floats  # that of a lone surface is its begin


def occupancy_map(world: World, config: MapConfig | None = None) -> OccupancyMap:
    """What a perfect mapper would find: the collision shapes cut at some heights.

    Surfaces and what they enclose are OCCUPIED, what can be reached from the start without
    crossing one is FREE, all else is UNKNOWN. Things thinner than half a cell may be missed.

    Args:
        world: is not changed.
        config: what to look at.

    Raises:
        Error: an illegal configuration, nothing within reach, a start within an obstacle, or a
            map of more than 10^8 cells.
    """
    config = config or MapConfig()
    config.validate()
    along = [_spans(world, config, axis) for axis in (0, 1)]
    origin, shape = _extent(along, config)
    surfaces = np.zeros(shape, bool)
    inner = np.zeros(shape, bool)
    for axis, spans in enumerate(along):
        _draw_solid(spans, axis, origin, config.resolution, surfaces, inner)
    for axis, spans in enumerate(along):
        _draw_lone(spans, axis, origin, config.resolution, surfaces, inner)
    cells = np.full(shape, UNKNOWN, np.int8)
    cells[reachable(surfaces | inner, origin, config)] = FREE
    cells[inner | surfaces] = OCCUPIED
    return OccupancyMap(cells, config.resolution, origin)


def _spans(world: World, config: MapConfig, axis: int) -> _Spans:
    """Lines along an axis through the square within reach, cut by each shape on its own."""
    pitch = config.resolution / _ROWS_PER_CELL
    count = 2 * math.ceil(config.reach / pitch)
    across = config.start[1 - axis] + (np.arange(count) - count / 2 + 0.5) * pitch
    first = config.start[axis] - config.reach
    parts = [_cut(world, axis, first, across, height, config) for height in config.heights]
    return _Spans(*(np.concatenate(values) for values in zip(*parts, strict=True)))


def _cut(
    world: World, axis: int, first: float, across: _Floats, height: float, config: MapConfig
) -> tuple[_Floats, _Floats, _Floats]:
    """Line, begin and end of each span, shape (n,) each."""
    place = np.full(across.size, first)
    line = np.arange(across.size)
    lines, shapes, places = [], [], []
    direction = np.zeros(3)
    direction[axis] = 1.0
    for _ in range(_MAX_SURFACES):
        if not line.size:
            break
        origins = np.empty((line.size, 3))
        origins[:, axis], origins[:, 1 - axis], origins[:, 2] = place, across[line], height
        hits = world.cast_rays(origins, np.broadcast_to(direction, origins.shape))
        hit = (hits.shape >= 0) & (place + hits.distance <= first + 2.0 * config.reach)
        line, place = line[hit], place[hit] + hits.distance[hit]
        lines.append(line)
        shapes.append(hits.shape[hit])
        places.append(place)
        place = place + _BEYOND_M
    if not lines:
        return (np.empty(0),) * 3
    found = paired(*(np.concatenate(values) for values in (lines, shapes, places)))
    return across[found[0]], found[2], found[3]


def paired(line: _Ints, shape: _Ints, place: _Floats) -> tuple[_Ints, _Ints, _Floats, _Floats]:
    """Entries and exits: surfaces of one shape on one line, two by two.

    An odd number of them (a shape that is not closed, or that a line touches) makes each a span of
    no length.

    Returns:
        Line, shape, begin and end of each span, shape (n,) each.
    """
    order = np.lexsort((place, shape, line))
    line, shape, place = line[order], shape[order], place[order]
    is_first = np.ones(line.size, bool)
    is_first[1:] = (line[1:] != line[:-1]) | (shape[1:] != shape[:-1])
    group = np.cumsum(is_first) - 1
    start = np.flatnonzero(is_first)
    size = np.diff(np.append(start, line.size))
    is_even = (size % 2 == 0)[group]
    rank = np.arange(line.size) - start[group]
    is_entry = ~is_even | (rank % 2 == 0)
    # Of an even group, the exit is the next one.
    after = np.minimum(np.arange(line.size) + 1, max(line.size - 1, 0))
    end = np.where(is_even, place[after], place)
    return line[is_entry], shape[is_entry], place[is_entry], end[is_entry]


def _corners(
    along: Sequence[_Spans], start: tuple[float, float]
) -> tuple[list[float], list[float]]:
    """The least and the largest x and y [m] of all spans and the start."""
    lowest, highest = list(start), list(start)
    for axis, spans in enumerate(along):
        if not spans.line.size:
            continue
        for place, low, high in (
            (axis, spans.begin, spans.end),
            (1 - axis, spans.line, spans.line),
        ):
            lowest[place] = min(lowest[place], float(low.min()))
            highest[place] = max(highest[place], float(high.max()))
    return lowest, highest


def _extent(
    along: Sequence[_Spans], config: MapConfig
) -> tuple[tuple[float, float], tuple[int, int]]:
    """Corner [m] and shape (rows, columns) of the grid around all spans and the start."""
    if not any(spans.line.size for spans in along):
        heights = ", ".join(f"{height:g}" for height in config.heights)
        raise Error(
            f"no obstacle within {config.reach:g} m of the start at a height of {heights} m"
        )
    lowest, highest = _corners(along, config.start)
    resolution = config.resolution
    corner = [math.floor((low - config.margin) / resolution) for low in lowest]
    other = [math.ceil((high + config.margin) / resolution) for high in highest]
    columns, rows = (end - begin for begin, end in zip(corner, other, strict=True))
    if rows * columns > _MAX_CELLS:
        raise Error(
            f"resolution: {resolution:g} m makes {columns} x {rows} cells, legal: up to 1e8; "
            "a smaller reach leaves out what is far away"
        )
    return (corner[0] * resolution, corner[1] * resolution), (rows, columns)


def _draw_solid(
    spans: _Spans,
    axis: int,
    origin: tuple[float, float],
    resolution: float,
    surfaces: npt.NDArray[np.bool_],
    inner: npt.NDArray[np.bool_],
) -> None:
    """Mark the ends of spans in `surfaces` and all of them in `inner`, shape (rows, columns)."""
    if axis == 1:
        surfaces, inner = surfaces.T, inner.T
    lines, length = surfaces.shape
    solid = spans.end > spans.begin
    row = np.floor((spans.line[solid] - origin[1 - axis]) / resolution).astype(np.int64)
    # A surface on the edge of two cells belongs to the one within the shape.
    begin = np.floor((spans.begin[solid] + _SAME_M - origin[axis]) / resolution).astype(np.int64)
    end = np.floor((spans.end[solid] - _SAME_M - origin[axis]) / resolution).astype(np.int64)
    end = np.maximum(begin, end)
    kept = (row >= 0) & (row < lines)
    row, begin, end = row[kept], begin[kept].clip(0, length - 1), end[kept].clip(0, length - 1)
    surfaces[row, begin] = True
    surfaces[row, end] = True
    steps = np.zeros((lines, length + 1), np.int32)
    np.add.at(steps, (row, begin), 1)
    np.add.at(steps, (row, end + 1), -1)
    inner |= np.cumsum(steps, axis=1)[:, :-1] > 0


def _draw_lone(
    spans: _Spans,
    axis: int,
    origin: tuple[float, float],
    resolution: float,
    surfaces: npt.NDArray[np.bool_],
    inner: npt.NDArray[np.bool_],
) -> None:
    """Mark surfaces without a second one: of open meshes, or of shapes whose faces coincide.

    Of two faces at one place a ray hits one. What is left of the other lies on the edge of a solid
    cell and adds nothing new.
    """
    if axis == 1:
        surfaces, inner = surfaces.T, inner.T
    lines, length = surfaces.shape
    lone = spans.end <= spans.begin
    row = np.floor((spans.line[lone] - origin[1 - axis]) / resolution).astype(np.int64)
    place = (spans.begin[lone] - origin[axis]) / resolution
    shift = _SAME_M / resolution
    near, far = (np.floor(place + sign * shift).astype(np.int64) for sign in (-1, 1))
    kept = (row >= 0) & (row < lines) & (near >= 0) & (far < length)
    row, near, far = row[kept], near[kept], far[kept]
    is_news = ~(inner[row, near] | inner[row, far])
    surfaces[row[is_news], near[is_news]] = True
    surfaces[row[is_news], far[is_news]] = True


def reachable(
    blocked: npt.NDArray[np.bool_], origin: tuple[float, float], config: MapConfig
) -> npt.NDArray[np.bool_]:
    """Cells joined by sides to that of the start, none of them blocked, shape (rows, columns).

    Raises:
        Error: the start is blocked, or outside.
    """
    labels, _ = ndimage.label(~blocked)
    x, y = config.start
    column, row = (
        math.floor((place - corner) / config.resolution)
        for place, corner in zip(config.start, origin, strict=True)
    )
    rows, columns = labels.shape
    is_inside = 0 <= row < rows and 0 <= column < columns
    here = labels[row, column] if is_inside else 0
    if here == 0:
        raise Error(f"start: ({x:g}, {y:g}) m is within an obstacle, legal: a free place")
    reached: npt.NDArray[np.bool_] = labels == here
    return reached
