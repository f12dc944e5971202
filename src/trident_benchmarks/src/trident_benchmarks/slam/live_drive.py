# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A long drive through a large office, for maps of thousands of nodes."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
BEAMS = 360
RANGE_MAX = 20.0  # [m]
RATE_HZ = 20.0
_PITCHES = (8.0, 12.0)  # [m] from corridor to corridor, no two the same
_CORRIDOR = 2.4  # [m] wide
_BUCKET = 5.0  # [m] side of the squares that know what can be seen from them


@dataclass(frozen=True)
class Drive:
    """Where the robot goes.

    Attributes:
        blocks: blocks of rooms along each side; corridors run between and around them.
        step: distance from scan to scan [m].
        seed: of niches, odometry and noise.
        range_sigma: noise of a range [m].
    """

    blocks: int = 9
    step: float = 0.175
    seed: int = 1
    range_sigma: float = 0.01


class Sample(NamedTuple):
    """One scan, the odometry at its stamp, and the truth; poses are x, y [m], yaw [rad]."""

    stamp: float
    truth: Array
    odometry: Array
    ranges: Array


def corridors(drive: Drive) -> Array:
    """Where the middles of the corridors are: x of columns and y of rows, shape (blocks + 1, 2)."""
    rng = np.random.default_rng([drive.seed, 2])
    pitches = rng.uniform(*_PITCHES, (drive.blocks, 2))
    return np.concatenate([np.zeros((1, 2)), np.cumsum(pitches, axis=0)])


def walls(drive: Drive) -> Array:
    """Segments of all walls, shape (n, 2, 2) [m], free space to their right; blocks differ."""
    rng = np.random.default_rng([drive.seed, 0])
    half = 0.5 * _CORRIDOR
    at = corridors(drive)
    outlines = [_box(-half, -half, at[-1, 0] + half, at[-1, 1] + half)[::-1]]
    for column in range(drive.blocks):
        for row in range(drive.blocks):
            low = np.array([at[column, 0], at[row, 1]]) + half
            high = np.array([at[column + 1, 0], at[row + 1, 1]]) - half
            outlines.append(_block(low, high, rng))
    return np.concatenate([np.stack([o, np.roll(o, -1, axis=0)], axis=1) for o in outlines])


def _box(x0: float, y0: float, x1: float, y1: float) -> Array:
    return np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]])


def _block(low: Array, high: Array, rng: np.random.Generator) -> Array:
    """A block's corners, counter-clockwise, with niches in each of its sides."""
    corners = []
    outline = _box(low[0], low[1], high[0], high[1])
    for at, to in zip(outline, np.roll(outline, -1, axis=0), strict=True):
        along = (to - at) / np.linalg.norm(to - at)
        inwards = np.array([-along[1], along[0]])
        length = float(np.linalg.norm(to - at))
        corners.append(at)
        places = np.sort(rng.uniform(0.6, length - 1.8, int(rng.integers(1, 4))))
        free_from = 0.0
        for place in places:
            if place < free_from:
                continue
            width, depth = rng.uniform(0.4, 1.2), rng.uniform(0.3, 1.5)
            begin, end = at + place * along, at + (place + width) * along
            corners += [begin, begin + depth * inwards, end + depth * inwards, end]
            free_from = place + width + 0.3
    return np.array(corners)


def _crossings(blocks: int) -> list[tuple[int, int]]:
    """Where the drive turns: number of the corridor along y and of that along x."""
    count = blocks + 1
    rows = [(x, y) for y in range(count) for x in ((0, blocks)[:: 1 if y % 2 == 0 else -1])]
    columns = []
    from_left = rows[-1][0] == 0
    for index, x in enumerate(range(count) if from_left else reversed(range(count))):
        ends = (blocks, 0) if index % 2 == 0 else (0, blocks)
        columns += [(x, y) for y in ends]
    return rows + columns[1:]


def poses(drive: Drive) -> Array:
    """True poses along all rows of corridors and then all columns, shape (n, 3)."""
    at_corridors = corridors(drive)
    crossings = _crossings(drive.blocks)
    corners = np.array([(at_corridors[x, 0], at_corridors[y, 1]) for x, y in crossings])
    result = []
    yaw = 0.0
    for at, to in pairwise(corners):
        along = to - at
        length = float(np.linalg.norm(along))
        heading = math.atan2(along[1], along[0])
        turn = math.remainder(heading - yaw, 2.0 * math.pi)
        turns = max(1, round(abs(turn) / 0.12))
        result += [[*at, yaw + turn * i / turns] for i in range(turns)]
        yaw = heading
        steps = round(length / drive.step)
        result += [[*(at + along * i / steps), yaw] for i in range(steps)]
    return np.array(result)


def samples(drive: Drive) -> Iterator[Sample]:
    """The scans of the drive, in order; odometry is wrong by 1 % and drifts."""
    rng = np.random.default_rng([drive.seed, 1])
    segments = walls(drive)
    truth = poses(drive)
    odometry = _odometry(truth, rng)
    visible: dict[tuple[int, int], Array] = {}
    for index, pose in enumerate(truth):
        bucket = (int(pose[0] // _BUCKET), int(pose[1] // _BUCKET))
        if bucket not in visible:
            visible[bucket] = _near(segments, (np.array(bucket) + 0.5) * _BUCKET)
        ranges = cast(visible[bucket], pose) + rng.normal(0.0, drive.range_sigma, BEAMS)
        yield Sample(index / RATE_HZ, pose, odometry[index], np.minimum(ranges, RANGE_MAX))


def _near(segments: Array, place: Array) -> Array:
    """The segments that come within the scanner's range of a square about a place."""
    along = segments[:, 1] - segments[:, 0]
    squared = np.einsum("ij,ij->i", along, along)
    part = np.einsum("ij,ij->i", place - segments[:, 0], along) / squared
    nearest = segments[:, 0] + np.clip(part, 0.0, 1.0)[:, None] * along
    return segments[np.linalg.norm(nearest - place, axis=1) < RANGE_MAX + _BUCKET]


def cast(segments: Array, pose: Array) -> Array:
    """True ranges [m] of a full turn of beams, infinite where nothing is hit."""
    angles = pose[2] + np.linspace(-math.pi, math.pi, BEAMS, endpoint=False)
    direction = np.stack([np.cos(angles), np.sin(angles)]).astype(np.float32)
    edge = (segments[:, 1] - segments[:, 0]).astype(np.float32)
    to = (segments[:, 0] - pose[:2]).astype(np.float32)
    is_faced = edge[:, 0] * to[:, 1] > edge[:, 1] * to[:, 0]
    edge, to = edge[is_faced], to[is_faced]
    with np.errstate(divide="ignore", invalid="ignore"):
        det = direction[0] * edge[:, 1, None] - direction[1] * edge[:, 0, None]
        ray = (to[:, 0] * edge[:, 1] - to[:, 1] * edge[:, 0])[:, None] / det
        wall = (to[:, 0, None] * direction[1] - to[:, 1, None] * direction[0]) / det
        ray[(ray <= 0.0) | (wall < 0.0) | (wall > 1.0) | np.isnan(ray)] = np.inf
    nearest: Array = ray.min(axis=0)
    return nearest


def _odometry(truth: Array, rng: np.random.Generator) -> Array:
    distances = np.linalg.norm(np.diff(truth[:, :2], axis=0), axis=1)
    turns = np.remainder(np.diff(truth[:, 2]) + math.pi, 2.0 * math.pi) - math.pi
    turns = 1.01 * turns + rng.normal(0.0, math.radians(0.5), len(distances)) * np.sqrt(distances)
    yaw = np.concatenate([[0.0], np.cumsum(turns)])
    steps = 1.01 * distances[:, None] * np.stack([np.cos(yaw[:-1]), np.sin(yaw[:-1])], axis=1)
    return np.column_stack([np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)]), yaw])


def write_log(drive: Drive, path: Path) -> int:
    """Write the drive as a CARMEN log (ROBOTLASER1) and return the number of its scans."""
    count = 0
    head = f"{-math.pi:.9f} {2.0 * math.pi:.9f} {2.0 * math.pi / BEAMS:.9f} {RANGE_MAX:g} 0.01 0"
    with path.open("w", encoding="ascii") as file:
        for one in samples(drive):
            ranges = " ".join(map("{:.3f}".format, one.ranges.tolist()))
            x, y, yaw = one.odometry
            pose = f"{x:.6f} {y:.6f} {yaw:.6f}"
            stamp = f"{one.stamp:.6f}"
            ends = f"0 {pose} {pose} 0 0 0 0 0 {stamp} sim {stamp}"
            file.write(f"ROBOTLASER1 0 {head} {BEAMS} {ranges} {ends}\n")
            count += 1
    return count
