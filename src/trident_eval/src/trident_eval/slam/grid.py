# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Occupancy maps as map_server reads them, and what can be said of one by itself."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from numpy.typing import NDArray

from trident_eval.core.errors import EvalError
from trident_eval.core.tracks import Array

UNKNOWN, FREE, OCCUPIED = -1, 0, 100
Cells = NDArray[np.int8]
_MIN_NEIGHBORS = 3  #: of a Gaussian through cells


@dataclass(frozen=True)
class Grid:
    """An occupancy map.

    Attributes:
        cells: UNKNOWN, FREE or OCCUPIED, shape (rows, columns); row 0 has the smallest y.
        resolution: side of a cell [m].
        origin: x [m], y [m] and yaw [rad] of the outer corner of cell (0, 0), shape (3,).
    """

    cells: Cells
    resolution: float
    origin: Array

    def centers(self, value: int) -> Array:
        """Centres of the cells that have this value, in the map's frame [m], shape (N, 2)."""
        rows, columns = np.nonzero(self.cells == value)
        local = self.resolution * (np.column_stack([columns, rows]) + 0.5)
        c, s = np.cos(self.origin[2]), np.sin(self.origin[2])
        return np.asarray(local @ np.array([[c, s], [-s, c]]) + self.origin[:2])


def read_grid(path: Path) -> Grid:
    """Read a map from its YAML file (trinary).

    Raises:
        EvalError: the file or its image is not what map_server would read.
    """
    about = _read_about(path)
    image = path.parent / str(about["image"])
    shades = _read_image(image)
    occupancy = shades / 255.0 if about.get("negate") else 1.0 - shades / 255.0
    cells = np.full(shades.shape, UNKNOWN, np.int8)
    cells[occupancy > float(about.get("occupied_thresh", 0.65))] = OCCUPIED
    cells[occupancy < float(about.get("free_thresh", 0.196))] = FREE
    return Grid(cells[::-1].copy(), float(about["resolution"]), np.array(about["origin"], float))


def _read_about(path: Path) -> dict[str, Any]:
    try:
        about = yaml.safe_load(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise EvalError(f"{path}: {error}; legal: the YAML file of a map") from error
    if not isinstance(about, dict) or not {"image", "resolution", "origin"} <= about.keys():
        raise EvalError(f"{path}: needs image, resolution and origin; legal: as map_saver writes")
    if not _has_place(about):
        raise EvalError(f"{path}: resolution above 0 m and origin [x, y, yaw] are needed")
    return about


def _has_place(about: dict[str, Any]) -> bool:
    """Whether size and place of the cells are numbers that can be."""
    try:
        return float(about["resolution"]) > 0 and np.shape(about["origin"]) == (3,)
    except (TypeError, ValueError):
        return False


def _read_image(path: Path) -> Array:
    from PIL import Image

    try:
        with Image.open(path) as image:
            return np.asarray(image.convert("L"), float)
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError) as error:
        raise EvalError(f"{path}: {error}; legal: a PGM or PNG image") from error


def wall_thickness(grid: Grid) -> float:
    """Median thickness [m] of what is occupied; walls seen from one side are a cell or two thick.

    The thickness at an occupied cell is the shortest of the four straight runs of occupied cells
    through it (along, across and both diagonals). nan when nothing is occupied.
    """
    occupied = grid.cells == OCCUPIED
    if not occupied.any():
        return float("nan")
    runs = []
    for step, length in (((0, 1), 1.0), ((1, 0), 1.0), ((1, 1), 2**0.5), ((1, -1), 2**0.5)):
        runs.append(length * _run_lengths(occupied, step)[occupied])
    return float(np.median(np.min(runs, axis=0)) * grid.resolution)


def mean_map_entropy(grid: Grid, radius_m: float = 0.3) -> float:
    """How blurred the walls are, without a truth [nat]: less is crisper.

    Mean over the occupied cells of the entropy of a Gaussian through the occupied cells within
    the radius, 0.5 ln det(2 pi e C) with C in m^2, cells taken as the squares that they are
    (after Razlaw et al. 2015, who ask points of scans). nan where nothing has neighbours.
    """
    from scipy.spatial import cKDTree

    cells = grid.centers(OCCUPIED)
    if len(cells) < _MIN_NEIGHBORS:
        return float("nan")
    pairs = cKDTree(cells).sparse_distance_matrix(cKDTree(cells), radius_m, output_type="ndarray")
    # A cell itself is its own neighbour, at a distance of zero.
    counts = np.bincount(pairs["i"], minlength=len(cells)).astype(float)
    x, y = (cells[pairs["j"]] - cells[pairs["i"]]).T
    mean_x, mean_y, xx, xy, yy = (
        np.bincount(pairs["i"], weights=values, minlength=len(cells)) / counts
        for values in (x, y, x * x, x * y, y * y)
    )
    within = grid.resolution**2 / 12.0  # variance of a square
    determinant = (xx - mean_x**2 + within) * (yy - mean_y**2 + within)
    determinant -= (xy - mean_x * mean_y) ** 2
    is_known = counts >= _MIN_NEIGHBORS
    if not is_known.any():
        return float("nan")
    return float(np.mean(0.5 * np.log((2.0 * np.pi * np.e) ** 2 * determinant[is_known])))


def _run_lengths(occupied: NDArray[np.bool_], step: tuple[int, int]) -> NDArray[np.int64]:
    """Of each cell, the number of occupied cells in a row through it along a step, itself too."""
    forward = _reach(occupied, step)
    backward = _reach(occupied, (-step[0], -step[1]))
    return np.where(occupied, forward + backward - 1, 0)


def _reach(occupied: NDArray[np.bool_], step: tuple[int, int]) -> NDArray[np.int64]:
    """Of each cell, how many occupied cells follow each other from it on along a step."""
    length = occupied.astype(np.int64)
    still = occupied.copy()
    for count in range(1, max(occupied.shape)):
        still &= _shifted(occupied, count * step[0], count * step[1])
        if not still.any():
            break
        length += still
    return length


def _shifted(cells: NDArray[np.bool_], down: int, right: int) -> NDArray[np.bool_]:
    """``cells[row + down, column + right]``, False outside."""
    rows, columns = cells.shape
    result = np.zeros_like(cells)
    if abs(down) >= rows or abs(right) >= columns:
        return result
    to_rows = slice(max(0, -down), rows - max(0, down))
    from_rows = slice(max(0, down), rows + min(0, down))
    to_columns = slice(max(0, -right), columns - max(0, right))
    from_columns = slice(max(0, right), columns + min(0, right))
    result[to_rows, to_columns] = cells[from_rows, from_columns]
    return result
